//! Pictures with names.

use crate::picture::RgbImage;

/// Picture with its file name and caption.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPicture {
    /// File name without folder and extension.
    pub name: String,
    /// Picture in display encoding.
    pub image: RgbImage,
    /// Caption, also the text alternative.
    pub caption: String,
    /// Rank of each pixel in downscaling, higher ranks win; missing ranks count as 0.
    pub(super) ranks: Vec<u8>,
}

impl NamedPicture {
    /// Creates a picture with its name and caption.
    pub fn new(name: impl Into<String>, image: RgbImage, caption: impl Into<String>) -> Self {
        Self { name: name.into(), image, caption: caption.into(), ranks: Vec::new() }
    }

    /// Marks pixels that must survive downscaling: a rank per pixel, 0 for those that need not.
    #[must_use]
    pub fn marked(self, ranks: Vec<u8>) -> Self {
        Self { ranks, ..self }
    }
}
