//! PNG files, and images from lists of samples.

use std::io::Cursor;
use std::ops::Deref;

use image::{EncodableLayout, ImageBuffer, ImageFormat, Pixel, PixelWithColorType, Rgb, RgbImage};

use super::error::PictureFormat;
use super::notes::PictureNotes;
use crate::error::InputError;
use crate::picture::error::{encode_error, samples_error};

/// Creates an image from its samples, pixel by pixel, rows from the top.
///
/// # Errors
/// [`InputError`] if their number does not match the size, or there are none.
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

/// Encodes an image as a PNG file.
///
/// # Errors
/// [`InputError`] if it has no pixels.
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

/// Encodes an image as a PNG file with notes as international text.
///
/// # Errors
/// [`InputError`] if it has no pixels.
pub fn png_with_notes(image: &RgbImage, notes: &PictureNotes) -> Result<Vec<u8>, InputError> {
    let mut file = Vec::new();
    let refused = |error: ::png::EncodingError| encode_error(PictureFormat::Png, error.to_string());
    let mut encoder = ::png::Encoder::new(&mut file, image.width(), image.height());
    encoder.set_color(::png::ColorType::Rgb);
    encoder.set_depth(::png::BitDepth::Eight);
    // As in files without notes.
    encoder.set_compression(::png::Compression::Fast);
    encoder.set_filter(::png::Filter::Adaptive);
    for (keyword, text) in [("Software", &notes.software), ("Comment", &notes.comments)] {
        if !text.is_empty() {
            // The format ends text with a zero.
            encoder.add_itxt_chunk(keyword.to_owned(), text.replace('\0', "")).map_err(refused)?;
        }
    }
    let mut writer = encoder.write_header().map_err(refused)?;
    writer.write_image_data(image.as_raw()).map_err(refused)?;
    writer.finish().map_err(refused)?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use image::Rgba;

    use super::*;

    #[test]
    fn sixteen_bits_come_back() {
        let samples = vec![0, 1, 0x1234, 0xffff, 0x8000, 7, 65534, 9];
        let file = png(&buffer::<Rgba<u16>>(2, 1, samples.clone()).expect("two pixels")).expect("a file");
        let back = image::load_from_memory(&file).expect("our own PNG");
        assert_eq!(back.into_rgba16().into_raw(), samples);
    }

    #[test]
    fn colors_come_back() {
        let pixels = [[1, 2, 3], [250, 251, 252]];
        let file = png(&rgb8(2, 1, pixels)).expect("two pixels");
        assert_eq!(image::load_from_memory(&file).expect("our own PNG").into_rgb8().into_raw(), pixels.as_flattened());
    }

    #[test]
    fn notes_stand_in_the_file_and_change_no_pixel() {
        let image = rgb8(2, 1, [[1, 2, 3], [250, 251, 252]]);
        let notes = PictureNotes {
            software: "crossbar".into(),
            comments: "caf\u{e9}\0 --out x".into(),
            ..PictureNotes::default()
        };
        let file = png_with_notes(&image, &notes).expect("two pixels");
        assert_eq!(image::load_from_memory(&file).expect("our own PNG").into_rgb8(), image);
        let reader = ::png::Decoder::new(Cursor::new(&file)).read_info().expect("our own PNG");
        let text: Vec<String> = reader.info().utf8_text.iter().map(|chunk| chunk.get_text().expect("text")).collect();
        assert_eq!(text, ["crossbar", "caf\u{e9} --out x"]);
        let without = png_with_notes(&image, &PictureNotes::default()).expect("two pixels");
        assert_eq!(without, png(&image).expect("two pixels"), "no notes, no difference");
        assert!(png_with_notes(&RgbImage::new(0, 0), &notes).is_err());
    }

    #[test]
    fn wrong_number_of_samples_is_an_error() {
        let error = buffer::<Rgb<u8>>(2, 2, vec![0; 11]).expect_err("one sample is missing");
        assert_eq!(error.to_string(), "expected 12 samples for a picture of 2x2, found 11");
        assert!(buffer::<Rgb<u8>>(0, 0, Vec::new()).is_err(), "an empty picture is no picture");
        assert!(png(&RgbImage::new(0, 0)).is_err(), "nor can it be a file");
    }
}
