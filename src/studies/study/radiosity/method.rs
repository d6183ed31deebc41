//! Methods of solution: a solver of the host, or equation 4 on the card.

use std::fmt;

use refsim::device::Profile;

use crate::card::CardError;
use crate::options::one_of::name;
use crate::radiosity::on_card::{CardSolution, Cycle, Storage};
use crate::radiosity::packing::Packing;
use crate::radiosity::solve::Solver;
use crate::study::StudyError;

/// Parameters of a solution on a card.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CardMethod {
    /// Layout of elements in texels.
    pub packing: Packing,
    /// Number format of registers, textures and targets.
    pub storage: Storage,
}

/// Method of solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SolveMethod {
    /// A solver of the host, in f64.
    Host(Solver),
    /// Fragment programs on a card.
    Card(CardMethod),
}

/// Reason why an iteration stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum StopReason {
    Tolerance,
    /// Repeating states.
    Cycle(Cycle),
    /// The maximum number; on a card, without a cycle.
    Iterations,
    /// The method does not iterate.
    Direct,
}

impl SolveMethod {
    /// Direct solution on the host.
    pub const DIRECT: Self = Self::Host(Solver::Direct);

    /// The method's layout and format, if it runs on a card.
    pub(super) fn on_card(&self) -> Option<CardMethod> {
        if let Self::Card(how) = self { Some(*how) } else { None }
    }

    /// Name, unique among methods on one device and valid as a file name.
    pub fn label(&self, profile: &Profile) -> String {
        match self {
            Self::Host(solver) => solver.to_string().replace(':', "-"),
            Self::Card(CardMethod { packing, storage }) => {
                format!("{}-{}-{}", profile.name, name(packing), name(storage))
            }
        }
    }
}

impl StopReason {
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

/// Error of the card.
pub(in crate::study) fn no_card(error: CardError) -> StudyError {
    StudyError::coded("radiosity::card", error)
}
