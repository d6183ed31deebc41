//! Pictures with names.

use crate::picture::RgbImage;

/// Picture with its file name and caption.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPicture {
    /// File name without folder and extension.
    pub name: String,
    /// Picture in display encoding.
    pub image: RgbImage,
    /// Caption; it is also the alternative text.
    pub caption: String,
}

impl NamedPicture {
    /// Creates a picture with its name and caption.
    pub fn new(name: impl Into<String>, image: RgbImage, caption: impl Into<String>) -> Self {
        Self { name: name.into(), image, caption: caption.into() }
    }
}
