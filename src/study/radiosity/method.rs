//! A method: a solver of the host, or equation 4 on the card.

use std::fmt;

use refsim::device::Profile;

use crate::radiosity::on_card::{CardSolution, Cycle, Storage};
use crate::radiosity::packing::Packing;
use crate::radiosity::solve::Solver;

/// How a system is solved on a card.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CardMethod {
    /// How elements lie in texels.
    pub packing: Packing,
    /// What registers, textures and targets hold.
    pub storage: Storage,
}

/// How a system is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SolveMethod {
    /// On the host, in f64.
    Host(Solver),
    /// By fragment programs.
    Card(CardMethod),
}

/// Why an iteration stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StopReason {
    /// The residual is small enough.
    Tolerance,
    /// The iteration is in a cycle of equal states.
    Cycle(Cycle),
    /// The most iterations were made; on a card, without a cycle.
    Iterations,
    /// The method does not iterate.
    Direct,
}

impl SolveMethod {
    /// Elimination on the host.
    pub const DIRECT: Self = Self::Host(Solver::Direct);

    /// A name that is unique among methods on one device, and fit for a file name.
    pub fn label(&self, profile: &Profile) -> String {
        match self {
            Self::Host(solver) => solver.to_string().replace(':', "-"),
            Self::Card(CardMethod { packing, storage }) => {
                let packing = if *packing == Packing::Rgb { "rgb" } else { "luminance" };
                let storage = if *storage == Storage::Fp32 { "fp32" } else { "fp16" };
                format!("{}-{packing}-{storage}", profile.name)
            }
        }
    }
}

impl StopReason {
    /// Why an iteration on a card stopped.
    pub(super) fn on_card(found: &CardSolution) -> Self {
        match (found.converged, found.cycle) {
            (true, _) => Self::Tolerance,
            (false, Some(cycle)) => Self::Cycle(cycle),
            (false, None) => Self::Iterations,
        }
    }
}

impl fmt::Display for StopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tolerance => f.write_str("tolerance"),
            Self::Cycle(cycle) if cycle.is_fixed_point() => f.write_str("fixed point"),
            Self::Cycle(cycle) => write!(f, "cycle of {}", cycle.period),
            Self::Iterations => f.write_str("iterations"),
            Self::Direct => f.write_str("elimination"),
        }
    }
}
