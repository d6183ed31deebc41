//! Radiance HDR files: three mantissas of 8 bits share an exponent, so that the brightest channel is accurate to 1/256.

use image::codecs::hdr::HdrEncoder;
use image::{ExtendedColorType, ImageEncoder as _};

use super::channels::Picture;
use super::error::PictureFormat;
use crate::error::InputError;
use crate::picture::error::encode_error;

/// Encodes the color of a picture as a Radiance HDR file. Values below 0 become 0.
pub fn hdr(picture: &Picture) -> Result<Vec<u8>, InputError> {
    let pixels = picture.linear()?;
    let bytes: Vec<u8> = pixels.as_flattened().iter().flat_map(|sample| sample.max(0.0).to_ne_bytes()).collect();
    let mut file = Vec::new();
    HdrEncoder::new(&mut file)
        .write_image(&bytes, picture.width(), picture.height(), ExtendedColorType::Rgb32F)
        .map_err(|error| encode_error(PictureFormat::Hdr, error.to_string()))?;
    Ok(file)
}
