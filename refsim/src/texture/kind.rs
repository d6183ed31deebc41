//! The kinds of texture.

use serde::Deserialize;

/// The kinds of texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize, strum::Display)]
#[serde(rename_all = "lowercase")]
pub enum TextureKind {
    /// A row of texels; height 1.
    #[serde(rename = "1d")]
    #[strum(serialize = "1-D")]
    D1,
    /// A plane.
    #[default]
    #[serde(rename = "2d")]
    #[strum(serialize = "2-D")]
    D2,
    /// A plane addressed in texels (not 0 to 1), without mip levels.
    #[strum(serialize = "rectangle")]
    Rectangle,
    /// Six square faces.
    #[strum(serialize = "cube")]
    Cube,
    /// A block.
    #[strum(serialize = "volume")]
    Volume,
}
