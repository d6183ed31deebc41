//! PNG files, and images from lists of samples.

use std::io::Cursor;
use std::ops::Deref;

use image::{EncodableLayout, ImageBuffer, ImageFormat, Pixel, PixelWithColorType, Rgb, RgbImage};

use super::error::PictureFormat;
use super::notes::PictureNotes;
use crate::error::InputError;
use crate::picture::error::{encode_error, samples_error};

/// Creates an image from its samples, pixel by pixel, rows from the top.
pub fn buffer<P: Pixel>(
    width: u32,
    height: u32,
    samples: Vec<P::Subpixel>,
) -> Result<ImageBuffer<P, Vec<P::Subpixel>>, InputError> {
    let (pixels, found) = (u64::from(width) * u64::from(height), samples.len() as u64);
    let expected = pixels.saturating_mul(u64::from(P::CHANNEL_COUNT));
    let refused = samples_error(width, height, expected, found);
    if found == expected && expected > 0 {
        ImageBuffer::from_vec(width, height, samples).ok_or(refused)
    } else {
        Err(refused)
    }
}

/// Creates an image of red, green and blue bytes, rows from the top; missing pixels are black.
pub fn rgb8(width: u32, height: u32, pixels: impl IntoIterator<Item = [u8; 3]>) -> RgbImage {
    let mut image = RgbImage::new(width, height);
    image.pixels_mut().zip(pixels).for_each(|(pixel, color)| *pixel = Rgb(color));
    image
}

/// Encodes an image as a PNG file. Fails with [`InputError`] if it has no pixels.
pub fn png<P, C>(image: &ImageBuffer<P, C>) -> Result<Vec<u8>, InputError>
where
    P: Pixel + PixelWithColorType,
    [P::Subpixel]: EncodableLayout,
    C: Deref<Target = [P::Subpixel]>,
{
    let mut file = Cursor::new(Vec::new());
    let refused = |error: image::ImageError| encode_error(PictureFormat::Png, error.to_string());
    image.write_to(&mut file, ImageFormat::Png).map_err(refused)?;
    Ok(file.into_inner())
}

/// Encodes an image as a PNG file with notes as international text. Fails with [`InputError`] if it has no pixels.
pub fn png_with_notes(image: &RgbImage, notes: &PictureNotes) -> Result<Vec<u8>, InputError> {
    let mut file = Vec::new();
    let refused = |error: ::png::EncodingError| encode_error(PictureFormat::Png, error.to_string());
    let mut encoder = ::png::Encoder::new(&mut file, image.width(), image.height());
    encoder.set_color(::png::ColorType::Rgb);
    encoder.set_depth(::png::BitDepth::Eight);
    // The same compression as in files without notes.
    encoder.set_compression(::png::Compression::Fast);
    encoder.set_filter(::png::Filter::Adaptive);
    for (keyword, text) in [("Software", &notes.software), ("Comment", &notes.comments)] {
        if !text.is_empty() {
            // PNG ends text with a zero byte, so text must not contain one.
            encoder.add_itxt_chunk(keyword.to_owned(), text.replace('\0', "")).map_err(refused)?;
        }
    }
    let mut writer = encoder.write_header().map_err(refused)?;
    writer.write_image_data(image.as_raw()).map_err(refused)?;
    writer.finish().map_err(refused)?;
    Ok(file)
}
