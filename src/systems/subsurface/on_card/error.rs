//! Errors of the three passes on a card.

use refsim::machine::MachineError;
use thiserror::Error;

use crate::card::{KernelError, MeshError};
use crate::subsurface::MaterialError;

/// Why a card does not scatter light.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum SubsurfaceCardError {
    /// A texture that the card does not have.
    #[error("device `{device}` has textures of at most {limit}x{limit} texels, {what} needs {width}x{height}")]
    TooLarge { device: String, what: &'static str, width: u32, height: u32, limit: u32 },
    /// More memory than the card has.
    #[error("expected at most {held} bytes in the memory of device `{device}`, the passes need {needed}: {parts}")]
    Memory { device: String, needed: u64, held: u64, parts: String },
    /// The device does not run a language, or refuses a program.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// A size or a figure that does not fit, or a draw that the card refuses.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// An index of refraction that no medium has.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A link's factor beyond the format of its texture, which would be infinite there.
    #[error(
        "expected factors of links of at most {largest:e} in textures of {format} texels, found {found:e}: the areas of the \
         model's texels differ too much; leave out faces that are far larger than the others, or store links in fp32"
    )]
    Factor { format: &'static str, largest: f32, found: f32 },
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
