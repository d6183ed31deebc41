//! Errors of bi-scale transfer on a card.

use refsim::machine::MachineError;
use refsim::texture::{TexelFormat, TextureError};
use thiserror::Error;

use crate::card::{KernelError, MeshError};

/// Errors of multiplying or displaying bi-scale transfer on a card.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum BiScaleCardError {
    /// Blocks or layers beyond a volume's limit.
    #[error(
        "{lights} x {lights} blocks of {pitch} x {pitch} texels in {layers} layers need a volume of {width} x {height} x \
         {layers}; `{device}` has volumes of {found} a side (limits.max_volume_size); take a smaller patch, or fewer \
         directions"
    )]
    Volume { lights: usize, pitch: usize, width: usize, height: usize, layers: usize, device: String, found: usize },
    /// More rows of texels than a texture has.
    #[error(
        "{count} {what} need a texture of {width} x {height} texels; `{device}` has textures of {found} a side \
         (limits.max_texture_size); take fewer"
    )]
    TextureSize { what: &'static str, count: usize, width: usize, height: usize, device: String, found: usize },
    /// Places beyond what single precision addresses.
    #[error("expected at most {most} {what}, whose places single precision tells apart, found {found}")]
    Places { what: &'static str, most: usize, found: usize },
    /// A value that single precision does not hold, not even rounded.
    #[error(
        "expected values of biclusters within single precision, found {found:e} in bicluster {bicluster}: scale the matrix"
    )]
    Value { bicluster: usize, found: f64 },
    /// No room for a direction.
    #[error(
        "a direction of light, texture coordinates and the view need 3 sets of texture coordinates; `{device}` has \
         {found} (limits.texture_coordinates)"
    )]
    Coordinates { device: String, found: usize },
    /// A format that does not hold what it is for.
    #[error("expected {what} in {expected}, found {found}")]
    Format { what: &'static str, expected: &'static str, found: TexelFormat },
    /// Float textures on a card that does not filter them.
    #[error("`{device}` filters no {format} textures (limits.float_filtering); hold samples in 8 bits")]
    FloatFilter { device: String, format: TexelFormat },
    /// A size or a figure that does not fit, or a draw that the card refuses.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A mesh without texture coordinates.
    #[error("the mesh has no texture coordinates, by which a bidirectional texture is placed")]
    NoTextureCoordinates,
    /// The device does not run a language, or refuses a program.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// An image that there cannot be.
    #[error(transparent)]
    Texture(#[from] TextureError),
    /// The card refused a resource or a draw, or could not be opened.
    #[error(transparent)]
    Machine(#[from] MachineError),
}
