//! Errors of drawing all-frequency transfer on a card.

use refsim::machine::MachineError;
use refsim::texture::TexelFormat;
use thiserror::Error;

use crate::card::{KernelError, MeshError};

/// Errors of drawing all-frequency transfer on a card. Vertices count from 0.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum FactoredCardError {
    /// More numbers than sets of coordinates hold.
    #[error(
        "{terms} terms of {channels} channels and {view} numbers of the view need {needed} sets of texture coordinates; \
         `{device}` has {found} (limits.texture_coordinates); draw a channel per pass, or take fewer terms"
    )]
    Coordinates { terms: usize, channels: usize, view: usize, needed: usize, device: String, found: usize },
    /// More maps than there are samplers.
    #[error("{terms} terms in {format} need {needed} textures; `{device}` has {found} samplers (limits.samplers)")]
    Samplers { terms: usize, format: TexelFormat, needed: usize, device: String, found: usize },
    /// More rows of texels than a texture has.
    #[error(
        "{count} {what} need {needed} rows of texels; `{device}` has textures of {found} (limits.max_texture_size); take \
         fewer"
    )]
    TextureSize { what: &'static str, count: usize, needed: usize, device: String, found: usize },
    /// Float maps on a card that does not filter them.
    #[error(
        "`{device}` filters no {format} textures (limits.float_filtering); filter by the program, or hold G in signed \
         fractions"
    )]
    FloatFilter { device: String, format: TexelFormat },
    /// Float maps on a card that has them as rectangles alone.
    #[error(
        "`{device}` has {format} textures as rectangles alone (limits.float_mipmaps), which ps_2_0 cannot address; hold \
         G in signed fractions"
    )]
    FloatRectangles { device: String, format: TexelFormat },
    /// A format of maps that cannot hold G.
    #[error("expected maps in floats or signed fractions of two or four components, found {found}")]
    MapFormat { found: TexelFormat },
    /// Two terms per texel together with filtering by the program.
    #[error("maps of two terms per texel are filtered by the sampler alone, found {found} filtered by the program")]
    TwoTerms { found: TexelFormat },
    /// A size or a figure that does not fit, or a draw that the card refuses.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The device does not run a language, or refuses a program.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// The card refused a resource or a draw, or could not be opened.
    #[error(transparent)]
    Machine(#[from] MachineError),
}
