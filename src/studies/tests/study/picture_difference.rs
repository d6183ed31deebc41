//! The difference of two pictures.

use crossbar_ground::picture::{ChannelUnit, Picture, Samples};
use crossbar_studies::study::picture_difference::{DifferenceOptions, PictureDifference, PictureInput};

use super::findings;

/// The value at the end of the false colors, for pixels with these differences.
fn scale(values: &[f32]) -> f64 {
    let input = |name: &str, values: Vec<f32>| {
        let picture = Picture::new(values.len() as u32, 1).with("Z", ChannelUnit::Unknown, Samples::Float(values));
        PictureInput { name: name.to_owned(), picture: picture.expect("a picture") }
    };
    let options = DifferenceOptions {
        channels: Vec::new(),
        exposure: 1.0,
        ppd: None,
        scale: None,
        max_rmse: None,
        max_error: None,
        max_flip: None,
        min_ssim: None,
    };
    let pictures = [input("first", vec![0.0; values.len()]), input("second", values.to_vec())];
    let document = findings(&PictureDifference { pictures, options, maps: true }).plain_document();
    document["scale"].as_f64().expect("a number")
}

#[test]
fn the_usual_scale_is_what_one_in_a_hundred_exceeds() {
    let mut values: Vec<f32> = (1..=100_u8).map(f32::from).collect();
    values.extend([0.0, f32::NAN]);
    assert_eq!(scale(&values), 99.0);
    assert_eq!(scale(&[0.0, -0.5]), 0.5);
    assert_eq!(scale(&[0.0]), 1.0);
}
