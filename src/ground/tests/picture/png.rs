use crossbar_ground::picture::{PictureNotes, buffer, png, png_with_notes, rgb8};
use image::{Rgb, RgbImage, Rgba};
use std::io::Cursor;

#[test]
fn sixteen_bits_come_back() {
    let samples = vec![0, 1, 0x1234, 0xffff, 0x8000, 7, 65534, 9];
    let file = png(&buffer::<Rgba<u16>>(2, 1, samples.clone()).expect("two pixels")).expect("a file");
    let back = image::load_from_memory(&file).expect("our own PNG");
    assert_eq!(back.into_rgba16().into_raw(), samples);
}

#[test]
fn notes_stand_in_the_file_and_change_no_pixel() {
    let image = rgb8(2, 1, [[1, 2, 3], [250, 251, 252]]);
    let notes =
        PictureNotes { software: "crossbar".into(), comments: "caf\u{e9}\0 --out x".into(), ..PictureNotes::default() };
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
