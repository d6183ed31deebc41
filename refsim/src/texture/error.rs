//! Errors of textures and images.

use std::str::FromStr;

use super::TextureKind;
use crate::texel::TexelFormat;

/// Error of creating or modifying an image.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum TextureError {
    /// There is no format with that name.
    #[error("expected a texel format such as `rgba8`, `rg16` or `rgba16f`, found `{name}`")]
    UnknownFormat { name: String },
    /// An extent is zero, too large, or invalid for the kind of texture.
    #[error("expected {expected} for a {kind} texture, found {width}x{height}x{depth}")]
    Extent { kind: TextureKind, expected: &'static str, width: u32, height: u32, depth: u32 },
    /// Too many or no mip levels.
    #[error("expected 1 to {most} mip levels, found {found}")]
    Levels { most: u32, found: u32 },
    /// The image would not fit the emulated memory.
    #[error("expected an image of at most {most} bytes, found {found}; make it smaller")]
    TooLarge { most: u64, found: u64 },
    /// The size of the data (in bytes, texels or 32-bit words) differs from the image's size.
    #[error("expected {expected} {unit} of texel data, found {found}")]
    DataSize { unit: &'static str, expected: usize, found: usize },
    /// Coordinates outside the image.
    #[error("expected a position inside level {level} of the image, found {what} {found} of {limit}")]
    Outside { level: u32, what: &'static str, found: u64, limit: u64 },
}

impl FromStr for TexelFormat {
    type Err = TextureError;

    /// Parses a name as [`TexelFormat::named`] does.
    fn from_str(text: &str) -> Result<Self, TextureError> {
        Self::named(text).ok_or_else(|| TextureError::UnknownFormat { name: text.chars().take(40).collect() })
    }
}
