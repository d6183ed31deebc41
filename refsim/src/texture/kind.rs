//! Kinds of textures.

use serde::Deserialize;

/// Kind of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize, strum::Display)]
#[serde(rename_all = "lowercase")]
pub enum TextureKind {
    /// One-dimensional: a row of texels, with height 1.
    #[serde(rename = "1d")]
    #[strum(serialize = "1-D")]
    D1,
    /// Two-dimensional.
    #[default]
    #[serde(rename = "2d")]
    #[strum(serialize = "2-D")]
    D2,
    /// Two-dimensional, addressed in texels (not 0 to 1), without mip levels.
    #[strum(serialize = "rectangle")]
    Rectangle,
    /// Cube map with six square faces.
    #[strum(serialize = "cube")]
    Cube,
    /// Three-dimensional.
    #[strum(serialize = "volume")]
    Volume,
}
