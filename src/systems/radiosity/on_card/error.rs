//! Errors of solving on a card.

use refsim::device::Profile;
use refsim::isa::Version;
use refsim::machine::MachineError;
use thiserror::Error;

use crate::card::KernelError;
use crate::radiosity::packing::TooLarge;

/// Error of solving a system on a card.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum CardError {
    /// The device has no shader version for programs of this length; `why` gives the reason, if known.
    #[error(
        "device `{device}` runs no `!!FP1.0` programs, in which the passes are written{why}; expected one of {have}"
    )]
    NoPrograms { device: String, why: String, have: String },
    /// A texture exceeds the card's maximum size.
    #[error("device `{device}`: {problem}")]
    TooLarge { device: String, problem: TooLarge },
    /// The device refuses a program.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// A size differs from that of the system on the card.
    #[error("expected {expected} {what}, found {found}")]
    Size { what: &'static str, expected: usize, found: usize },
    /// The iteration diverges.
    #[error("expected an iteration that converges, found no finite residual after {iterations} iterations")]
    Diverged { iterations: u32 },
    /// The card refuses a resource or a draw, or does not open.
    #[error(transparent)]
    Machine(#[from] MachineError),
}

impl CardError {
    /// The error for a device without programs of such length.
    pub(super) fn no_programs(profile: &Profile) -> Self {
        let runs = |name: &&str| Profile::named(name).is_ok_and(|p| p.limits.versions.contains(&Version::Fp1_0));
        let mut have: Vec<&str> = Profile::card_names().into_iter().filter(runs).collect();
        have.push("ideal-<format>");
        let chain = |reads: u32| {
            format!(
                " (its own allow a chain of {reads} dependent reads (limits.dependent_reads); a block has hundreds)"
            )
        };
        let why = profile.limits.dependent_reads.map_or_else(String::new, chain);
        Self::NoPrograms { device: profile.name.clone(), why, have: have.join(", ") }
    }
}
