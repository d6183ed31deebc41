//! Pixels of images as numbers, and as PNG files.

use refsim::texture::{Image, ImagePixel, TexelFormat};

#[test]
fn pixels_come_row_by_row_with_what_is_stored() {
    let mut image = Image::new_2d(TexelFormat::Bgra8, 3, 2).expect("six texels");
    image.set_raw(0, 0, 1, 2, 0x80ff_0033);
    let pixels: Vec<ImagePixel> = image.pixels().collect();
    assert_eq!(
        pixels.iter().map(|pixel| (pixel.x, pixel.y)).collect::<Vec<_>>()[..4],
        [(0, 0), (1, 0), (2, 0), (0, 1)]
    );
    assert_eq!(pixels[5].rgba, [1.0, 0.0, 0.2, 128.0 / 255.0]);
    assert_eq!((image.pixel(3, 0), image.pixel(0, 2)), (None, None));
}

#[test]
fn every_value_of_floats_has_its_decimal() {
    let mut image = Image::new_2d(TexelFormat::Rgba32f, 1, 1).expect("a texel");
    let bits = [f32::from_bits(1), -1.5, f32::NEG_INFINITY, f32::MAX].map(f32::to_bits);
    image.bytes_mut().copy_from_slice(&bits.map(u32::to_le_bytes).concat());
    let expected = [f64::from(f32::from_bits(1)), -1.5, f64::NEG_INFINITY, f64::from(f32::MAX)];
    assert_eq!(image.pixel(0, 0), Some(expected));
}

#[cfg(feature = "png")]
#[test]
fn a_png_holds_every_code() {
    let mut image = Image::new_2d(TexelFormat::Bgra8, 16, 16).expect("256 texels");
    for code in 0..256_u32 {
        image.set_raw(0, 0, code / 16, code % 16, u128::from(0xff00_0000 | code << 16 | (255 - code)));
    }
    let file = image.to_png();
    let mut reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().expect("a PNG file");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a small picture")];
    let info = reader.next_frame(&mut bytes).expect("one picture");
    assert_eq!((info.width, info.height, info.color_type), (16, 16, png::ColorType::Rgba));
    let expected: Vec<u8> = (0..=255).flat_map(|code| [code, 0, 255 - code, 255]).collect();
    assert_eq!(bytes, expected);
}
