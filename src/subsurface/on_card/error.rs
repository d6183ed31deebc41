//! Errors of the three passes on a card.

use refsim::device::Profile;
use refsim::isa::Version;
use refsim::machine::MachineError;
use thiserror::Error;

use crate::card::KernelError;

/// Why a card does not scatter light.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum SubsurfaceCardError {
    /// The card has no programs of this kind.
    #[error(
        "device `{device}` runs no `!!FP1.0` and `vs_2_0` programs, in which the passes are written; expected one of {have}"
    )]
    NoPrograms { device: String, have: String },
    /// A texture that the card does not have.
    #[error("device `{device}` has textures of at most {limit}x{limit} texels, {what} needs {width}x{height}")]
    TooLarge { device: String, what: &'static str, width: u32, height: u32, limit: u32 },
    /// More memory than the card has.
    #[error("expected at most {held} bytes in the memory of device `{device}`, the passes need {needed}: {parts}")]
    Memory { device: String, needed: u64, held: u64, parts: String },
    /// The device refuses a program.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// A size that differs from that of the model on the card.
    #[error("expected {expected} {what}, found {found}")]
    Size { what: &'static str, expected: usize, found: usize },
    /// A figure out of its range.
    #[error("expected {what}, found {found}")]
    Figure { what: &'static str, found: f64 },
    /// A light that cannot be.
    #[error("light {light} (counted from 0): expected {what}")]
    Light { light: usize, what: &'static str },
    /// More lights than a program of pass 3 has room for.
    #[error("found {found} lights beside skies, a program of direct light on device `{device}` takes at most {most}")]
    Lights { device: String, found: usize, most: usize },
    /// No program of pass 2 takes a link.
    #[error("device `{device}` has no room for a link in a program: {samplers} samplers, {constants} constants")]
    NoRoom { device: String, samplers: u32, constants: u32 },
    /// The card refuses a resource or a draw, or does not open.
    #[error(transparent)]
    Machine(#[from] MachineError),
}

impl SubsurfaceCardError {
    /// For a device without programs of this kind.
    pub(super) fn no_programs(profile: &Profile) -> Self {
        let runs = |name: &&str| Profile::named(name).is_ok_and(|p| has_programs(&p));
        let have: Vec<&str> = Profile::card_names().into_iter().filter(runs).collect();
        Self::NoPrograms { device: profile.name.clone(), have: have.join(", ") }
    }
}

/// Whether a device runs the languages of the passes.
pub(super) fn has_programs(profile: &Profile) -> bool {
    [Version::Fp1_0, Version::Vs2_0].iter().all(|version| profile.limits.versions.contains(version))
}

/// Whether two sizes agree.
pub(super) fn same(what: &'static str, expected: usize, found: usize) -> Result<(), SubsurfaceCardError> {
    if expected == found { Ok(()) } else { Err(SubsurfaceCardError::Size { what, expected, found }) }
}
