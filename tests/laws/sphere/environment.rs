//! Light from pictures: orientation, accuracy, files, refusals, threads.

use crossbar::picture::{NO_COLOR, Picture};
use crossbar::sphere::{EnvironmentLayout, HarmonicLight};
use proptest::prelude::*;

fn light(order: usize, picture: &Picture) -> HarmonicLight {
    HarmonicLight::from_picture(order, picture).expect("a light")
}

fn gradient(width: u32, height: u32) -> Picture {
    let pixel = |at: u32| [at % width, at / width, at].map(|value| (value % 16) as f32 / 16.0 + 0.25);
    Picture::rgb(width, height, &(0..width * height).map(pixel).collect::<Vec<_>>())
}

#[test]
fn a_picture_without_color_is_refused() {
    let refused = HarmonicLight::from_picture(3, &Picture::new(64, 32)).expect_err("refused");
    assert_eq!(refused.error_code(), NO_COLOR);
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
