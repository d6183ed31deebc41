//! The kinds of texture.

/// The kinds of texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureKind {
    /// A row of texels; height 1.
    D1,
    /// A plane.
    D2,
    /// A plane addressed in texels (not 0 to 1), without mip levels.
    Rectangle,
    /// Six square faces.
    Cube,
    /// A block.
    Volume,
}

impl std::fmt::Display for TextureKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::D1 => "1-D",
            Self::D2 => "2-D",
            Self::Rectangle => "rectangle",
            Self::Cube => "cube",
            Self::Volume => "volume",
        })
    }
}
