//! PNG files from samples.

use image::{ExtendedColorType, ImageEncoder as _, codecs::png::PngEncoder};

use super::{ReportError, expect_samples};

fn png(
    width: usize,
    height: usize,
    channels: usize,
    bytes_per_sample: usize,
    color: ExtendedColorType,
    bytes: &[u8],
) -> Result<Vec<u8>, ReportError> {
    expect_samples(width, height, channels, bytes.len() / bytes_per_sample)?;
    let too_large = |_| ReportError::encode("PNG")(&"a side is longer than 2^32 - 1 pixels");
    let (w, h) = (u32::try_from(width).map_err(too_large)?, u32::try_from(height).map_err(too_large)?);
    let mut file = Vec::new();
    PngEncoder::new(&mut file).write_image(bytes, w, h, color).map_err(|error| ReportError::encode("PNG")(&error))?;
    Ok(file)
}

/// A PNG of red, green, blue, 8 bits each, rows from the top.
///
/// # Errors
/// If there are not `3 * width * height` samples, or none.
pub fn rgb8(width: usize, height: usize, samples: &[u8]) -> Result<Vec<u8>, ReportError> {
    png(width, height, 3, 1, ExtendedColorType::Rgb8, samples)
}

/// A PNG of red, green, blue, alpha, 8 bits each, rows from the top.
///
/// # Errors
/// If there are not `4 * width * height` samples, or none.
pub fn rgba8(width: usize, height: usize, samples: &[u8]) -> Result<Vec<u8>, ReportError> {
    png(width, height, 4, 1, ExtendedColorType::Rgba8, samples)
}

/// A PNG of one channel of 16 bits, rows from the top.
///
/// # Errors
/// If there are not `width * height` samples, or none.
pub fn gray16(width: usize, height: usize, samples: &[u16]) -> Result<Vec<u8>, ReportError> {
    // The encoder takes 16-bit samples as bytes in the host's order.
    let bytes: Vec<u8> = samples.iter().flat_map(|s| s.to_ne_bytes()).collect();
    png(width, height, 1, 2, ExtendedColorType::L16, &bytes)
}

/// A PNG of red, green, blue, alpha, 16 bits each, rows from the top.
///
/// # Errors
/// If there are not `4 * width * height` samples, or none.
pub fn rgba16(width: usize, height: usize, samples: &[u16]) -> Result<Vec<u8>, ReportError> {
    let bytes: Vec<u8> = samples.iter().flat_map(|s| s.to_ne_bytes()).collect();
    png(width, height, 4, 2, ExtendedColorType::Rgba16, &bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_bits_come_back() {
        let samples = [0, 1, 0x1234, 0xffff, 0x8000, 7];
        let file = gray16(3, 2, &samples).expect("six samples for 3x2");
        let back = image::load_from_memory(&file).expect("our own PNG");
        assert_eq!(back.into_luma16().into_raw(), samples);
    }

    #[test]
    fn colours_come_back() {
        let samples = [1, 2, 3, 250, 251, 252];
        let file = rgb8(2, 1, &samples).expect("two pixels");
        assert_eq!(image::load_from_memory(&file).expect("our own PNG").into_rgb8().into_raw(), samples);
    }

    #[test]
    fn wrong_number_of_samples_is_an_error() {
        let error = rgb8(2, 2, &[0; 11]).expect_err("one sample is missing");
        assert_eq!(error.to_string(), "expected 12 samples for a picture of 2x2, found 11");
        assert!(rgb8(0, 0, &[]).is_err(), "an empty picture is no picture");
    }
}
