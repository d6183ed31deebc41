//! Errors of textures and images.

use super::TextureKind;

/// Why an image can't be made or changed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextureError {
    /// No format of that name.
    #[error("expected a texel format as `rgba8`, `rg16` or `rgba16f`, found `{name}`")]
    UnknownFormat {
        /// What was given.
        name: String,
    },
    /// An extent is zero, too large, or not what the kind of texture asks for.
    #[error("expected {expected} for a {kind} texture, found {width}x{height}x{depth}")]
    Extent {
        /// The kind asked for.
        kind: TextureKind,
        /// What the kind allows.
        expected: &'static str,
        /// Width in texels.
        width: u32,
        /// Height in texels.
        height: u32,
        /// Depth in texels.
        depth: u32,
    },
    /// Too many or no mip levels.
    #[error("expected 1 to {most} mip levels, found {found}")]
    Levels {
        /// Levels of a full chain.
        most: u32,
        /// Levels asked for.
        found: u32,
    },
    /// The image would not fit the emulated memory.
    #[error("expected an image of at most {most} bytes, found {found}; make it smaller")]
    TooLarge {
        /// The limit in bytes.
        most: u64,
        /// Bytes asked for.
        found: u64,
    },
    /// The data do not have the size of the image.
    #[error("expected {expected} {unit} of texel data, found {found}")]
    DataSize {
        /// What is counted: bytes, texels or 32-bit words.
        unit: &'static str,
        /// Size that fits.
        expected: usize,
        /// Size given.
        found: usize,
    },
    /// A place outside the image.
    #[error("expected a place inside level {level} of the image, found {what} {found} where {limit} exist")]
    Outside {
        /// The mip level addressed.
        level: u32,
        /// Which coordinate is at fault.
        what: &'static str,
        /// The coordinate, or the first past the region.
        found: u64,
        /// How many there are.
        limit: u64,
    },
}
