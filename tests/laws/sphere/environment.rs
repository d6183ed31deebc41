//! Light from pictures: orientation, accuracy, files, refusals, threads.

use std::f64::consts::PI;

use crossbar::elementary::sin_cos;
use crossbar::picture::{NO_COLOR, Picture, exr, hdr, png};
use crossbar::sphere::{EnvironmentLayout, Extremes, HarmonicLight, evaluate};
use glam::DVec3;
use proptest::prelude::*;

use super::distance;
use crate::support::in_threads;

/// Pictures of all layouts, and the position of a pixel near each axis: +x, -x, +y, -y, +z, -z.
const LABELLED: [(EnvironmentLayout, [u32; 2], [[u32; 2]; 6]); 4] = [
    (EnvironmentLayout::LatLong, [64, 32], [[48, 16], [15, 16], [32, 15], [0, 16], [32, 0], [32, 31]]),
    (EnvironmentLayout::AngularProbe, [64, 64], [[47, 32], [16, 31], [32, 32], [31, 63], [32, 16], [31, 47]]),
    (EnvironmentLayout::CubeCross, [64, 48], [[40, 24], [8, 24], [24, 24], [56, 24], [24, 8], [24, 40]]),
    (EnvironmentLayout::CubeCross, [48, 64], [[40, 24], [8, 24], [24, 24], [24, 56], [24, 8], [24, 40]]),
];

const AXES: [DVec3; 6] = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];

fn light(order: usize, picture: &Picture) -> HarmonicLight {
    HarmonicLight::from_picture(order, picture).expect("a light")
}

#[test]
fn a_bright_texel_shines_from_its_axis() {
    for (layout, [width, height], places) in LABELLED {
        for (axis, [column, row]) in AXES.into_iter().zip(places) {
            let mut pixels = vec![[0.0; 3]; (width * height) as usize];
            pixels[(row * width + column) as usize] = [1.0, 2.0, 4.0];
            let light = light(10, &Picture::rgb(width, height, &pixels));
            let [red, green, blue] = light.channels();
            let Extremes { largest_at, .. } = Extremes::of(red);
            assert!(largest_at.distance(axis) < 0.1, "{layout} {width}x{height}: {axis} found at {largest_at}");
            for (channel, factor) in [(green, 2.0), (blue, 4.0)] {
                let scaled: Vec<f64> = red.iter().map(|c| factor * c).collect();
                assert!(distance(channel, &scaled) < 1e-15, "{layout}: channels keep their places");
            }
        }
    }
}

/// Orientation of pictures around the axes: a bright texel right of and above the middle of each side of the view.
#[test]
fn pictures_are_not_mirrored() {
    for (layout, [width, height], [_, _, [column, row], ..]) in LABELLED {
        let mut pixels = vec![[0.0; 3]; (width * height) as usize];
        pixels[((row - 4) * width + column + 4) as usize] = [1.0; 3];
        let at = Extremes::of(&light(10, &Picture::rgb(width, height, &pixels)).channels()[0]).largest_at;
        assert!(at.x > 0.1 && at.y > 0.5 && at.z > 0.1, "{layout}: right and up of the middle is at {at}");
    }
    // The back faces of both crosses show the same side from inside: left in the wide cross is right in the tall one.
    let back = |[width, height]: [u32; 2], [column, row]: [u32; 2]| {
        let mut pixels = vec![[0.0; 3]; (width * height) as usize];
        pixels[(row * width + column) as usize] = [1.0; 3];
        Extremes::of(&light(10, &Picture::rgb(width, height, &pixels)).channels()[0]).largest_at
    };
    let [wide, tall] = [back([64, 48], [52, 20]), back([48, 64], [27, 59])];
    assert!(wide.x > 0.1 && wide.y < -0.5 && wide.z > 0.1, "turning right from +x: {wide}");
    assert!(wide.distance(tall) < 1e-6, "{wide} {tall}");
}

#[test]
fn a_constant_picture_is_a_constant() {
    let mut white = vec![0.0; 100];
    white[0] = (4.0 * PI).sqrt();
    for (layout, [width, height], _) in LABELLED {
        for scale in [1, 3] {
            let [width, height] = [width * scale, height * scale];
            let found = light(10, &Picture::rgb(width, height, &vec![[1.0; 3]; (width * height) as usize]));
            let channel = &found.channels()[2];
            assert!((channel[0] - white[0]).abs() < 2e-14, "{layout} {width}x{height}: {}", channel[0]);
            let off = distance(channel, &white);
            let bound = if layout == EnvironmentLayout::AngularProbe { 2e-7 } else { 1e-8 };
            assert!(off < bound, "{layout} {width}x{height}: {off:e}");
        }
    }
}

/// A light of order 3 is recovered from a picture that has its values at the pixels' centers.
#[test]
fn a_lat_long_picture_gives_back_the_light_that_it_was_painted_with() {
    let expected = [2.0, 0.3, -0.4, 0.5, 0.1, 0.2, -0.3, 0.2, 0.1];
    let direction = |column: usize, row: usize| {
        let (sin_polar, cos_polar) = sin_cos(PI * (row as f64 + 0.5) / 128.0);
        let (right, forward) = sin_cos(2.0 * PI * ((column as f64 + 0.5) / 256.0 - 0.5));
        DVec3::new(sin_polar * right, sin_polar * forward, cos_polar)
    };
    let pixels: Vec<[f32; 3]> =
        (0..256 * 128).map(|at| [evaluate(&expected, direction(at % 256, at / 256)) as f32; 3]).collect();
    let found = light(3, &Picture::rgb(256, 128, &pixels));
    let off = distance(&found.channels()[0], &expected);
    assert!(off < 3e-4, "{off:e}");
}

fn gradient(width: u32, height: u32) -> Picture {
    let pixel = |at: u32| [at % width, at / width, at].map(|value| (value % 16) as f32 / 16.0 + 0.25);
    Picture::rgb(width, height, &(0..width * height).map(pixel).collect::<Vec<_>>())
}

#[test]
fn files_give_the_light_of_their_picture() {
    let picture = gradient(64, 32);
    let expected = light(5, &picture);
    let off = |bytes: &[u8]| {
        let read = light(5, &Picture::decode(bytes).expect("a picture"));
        (0..3).map(|channel| distance(&read.channels()[channel], &expected.channels()[channel])).fold(0.0, f64::max)
    };
    assert_eq!(off(&exr(&picture).expect("a file")), 0.0, "EXR keeps every bit");
    assert!(off(&hdr(&picture).expect("a file")) < 0.02, "HDR keeps 8 bits and an exponent");
    let shown = picture.display(1.0).expect("a picture");
    let eight_bit = png(&shown).expect("a file");
    let clipped: Vec<[f32; 3]> =
        picture.linear().expect("color").iter().map(|pixel| pixel.map(|channel| channel.min(1.0))).collect();
    let clipped = light(5, &Picture::rgb(64, 32, &clipped));
    let read = light(5, &Picture::decode(&eight_bit).expect("a picture"));
    assert!(distance(&read.channels()[0], &clipped.channels()[0]) < 0.01, "PNG is decoded from sRGB");
}

#[test]
fn what_is_no_environment_is_refused() {
    let refused = |picture: &Picture| HarmonicLight::from_picture(3, picture).expect_err("refused");
    assert_eq!(
        refused(&gradient(65, 32)).to_string(),
        "expected a lat-long picture (width twice the height), an angular probe (a square), a cube \
         cross (4:3 or 3:4, of whole squares) or a cube strip (1:6), found 65x32"
    );
    assert_eq!(refused(&Picture::new(64, 32)).error_code(), NO_COLOR);
    for bad in [f32::NAN, f32::INFINITY] {
        let mut pixels = vec![[1.0; 3]; 64 * 32];
        pixels[5 * 64 + 7][1] = bad;
        let error = refused(&Picture::rgb(64, 32, &pixels));
        assert!(error.to_string().contains("in channel green of the pixel in column 7, row 5"), "{error}");
    }
}

#[test]
fn pixels_that_show_nothing_are_not_read() {
    for (layout, [width, height], hidden) in
        [(EnvironmentLayout::AngularProbe, [32, 32], 0), (EnvironmentLayout::CubeCross, [32, 24], 31)]
    {
        let clean = gradient(width, height);
        let mut pixels = clean.linear().expect("color");
        pixels[hidden] = [f32::NAN; 3];
        assert_eq!(light(4, &Picture::rgb(width, height, &pixels)), light(4, &clean), "{layout}");
    }
}

proptest! {
    /// Any picture yields a light with finite coefficients, or an error that states the reason.
    #[test]
    fn any_picture_is_a_light_or_refused(
        width in 0..17u32,
        height in 0..17u32,
        samples in prop::collection::vec(prop_oneof![8 => -10.0..1e4f32, 1 => any::<f32>()], 16),
        order in 1..11usize,
    ) {
        let pixel = |at: u32| [0, 1, 2].map(|channel| samples[(at as usize * 5 + channel) % samples.len()]);
        let picture = Picture::rgb(width, height, &(0..width * height).map(pixel).collect::<Vec<_>>());
        match HarmonicLight::from_picture(order, &picture) {
            Ok(light) => prop_assert!(light.channels().iter().flatten().all(|c| c.is_finite())),
            Err(error) if error.error_code() == "crossbar::sphere::shape" => {
                prop_assert_eq!(EnvironmentLayout::of(width, height), None);
            }
            Err(error) => {
                let told = |at: u32| {
                    let place = format!(" of the pixel in column {}, row {} (counted from 0", at % width, at / width);
                    ["red", "green", "blue"].iter().zip(pixel(at)).any(|(channel, value)| {
                        let found = format!("expected finite radiance, found {value} in channel {channel}{place}");
                        !value.is_finite() && error.to_string().starts_with(&found)
                    })
                };
                prop_assert!((0..width * height).any(told), "{}", error);
            }
        }
    }
}

#[test]
fn threads_change_no_bit() {
    let picture = gradient(128, 128);
    let on = |threads| in_threads(threads, || light(7, &picture));
    assert_eq!(on(1), on(3));
}
