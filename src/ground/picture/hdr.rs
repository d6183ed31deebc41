//! Radiance HDR files: three mantissas of 8 bits share an exponent, so that the brightest channel is accurate to 1/256.

use image::codecs::hdr::HdrEncoder;
use image::{ExtendedColorType, ImageEncoder as _};

use super::channels::Picture;
use super::error::{PictureError, PictureFormat};

/// Encodes the color of a picture as a Radiance HDR file. Values below 0 become 0.
///
/// # Errors
/// [`PictureError::NoColor`], or [`PictureError::Encode`] if the encoder fails.
pub fn hdr(picture: &Picture) -> Result<Vec<u8>, PictureError> {
    let pixels = picture.linear()?;
    let bytes: Vec<u8> = pixels.as_flattened().iter().flat_map(|sample| sample.max(0.0).to_ne_bytes()).collect();
    let mut file = Vec::new();
    HdrEncoder::new(&mut file)
        .write_image(&bytes, picture.width(), picture.height(), ExtendedColorType::Rgb32F)
        .map_err(|error| PictureError::Encode { format: PictureFormat::Hdr, reason: error.to_string() })?;
    Ok(file)
}
