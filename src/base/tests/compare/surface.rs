use approx::assert_abs_diff_eq;
use crossbar_base::compare::images;
use refsim::num::Format;
use refsim::texture::{Image, TargetRounding, TexelFormat};

fn image(format: TexelFormat, values: [f32; 4]) -> Image {
    let mut image = Image::new_2d(format, 2, 1).expect("a small image");
    image.store([0, 0, 0, 1], Format::FP32, values.map(f32::to_bits), TargetRounding::Nearest).expect("inside");
    image
}

#[test]
fn one_code_of_eight_bits() {
    let [a, b] = [1.0, 254.0 / 255.0].map(|red| image(TexelFormat::Rgba8, [red, 0.5, 0.0, 1.0]));
    let found = images("target 0", &a, &b).expect("one format");
    assert_eq!((found.pixels, found.different, found.map.as_slice()), (2, 1, &[false, true][..]));
    let largest = found.largest.expect("a difference");
    assert_eq!((largest.pixel, largest.values.name.as_str(), largest.values.ulps), ([1, 0], "red", Some(1.0)));
    assert_eq!((largest.values.left_bits.as_str(), largest.values.right_bits.as_str()), ("0xff", "0xfe"));
    assert_abs_diff_eq!(largest.difference, 1.0 / 255.0, epsilon = 1e-12);
}

#[test]
fn nan_is_farthest() {
    let a = image(TexelFormat::Rgba32f, [1.0, f32::NAN, 0.0, 1.0]);
    let b = image(TexelFormat::Rgba32f, [1e30, 1.0, 0.0, 1.0]);
    let largest = images("target 0", &a, &b).and_then(|found| found.largest).expect("a difference");
    assert_eq!((largest.values.name.as_str(), largest.difference, largest.values.ulps), ("green", f64::INFINITY, None));
}

#[test]
fn shapes_that_differ_have_no_difference() {
    let a = image(TexelFormat::Rgba8, [0.0; 4]);
    assert!(images("target 0", &a, &image(TexelFormat::Rgba32f, [0.0; 4])).is_none());
}
