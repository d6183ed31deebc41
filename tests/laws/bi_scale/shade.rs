//! Pixels shaded by equation 3.

use approx::assert_relative_eq;
use crossbar::prt::bi_scale::directions::{LocalDirections, hemisphere};
use crossbar::prt::bi_scale::shade::{ShadedPixel, TextureLookup, pixel_frame, reference};
use crossbar::prt::bi_scale::texture::BidirectionalTexture;
use crossbar::prt::synthetic::hills;
use crossbar::prt::transfer::{Tangents, Vertices};
use glam::DVec3;
use proptest::prelude::*;

const VERTICES: u32 = 5;

/// Views, lights and texels along an edge.
fn sizes() -> impl Strategy<Value = [usize; 3]> {
    [1..4_usize, 1..4_usize, 1..5_usize]
}

fn texture([view, light, size]: [usize; 3], values: &[f32]) -> BidirectionalTexture {
    let [view, light] = [view, light].map(|side| LocalDirections::new(side).expect("directions"));
    let count = view.directions().len() * light.directions().len() * size * size;
    let samples = (0..count).map(|at| [0, 1, 2].map(|channel| values[(3 * at + channel) % values.len()]));
    BidirectionalTexture::new(size, view, light, samples.collect()).expect("a texture")
}

fn pixel() -> impl Strategy<Value = ShadedPixel> {
    let place = [-3.0..3.0_f64, -3.0..3.0_f64];
    let view = [-1.0..1.0_f64, -1.0..1.0_f64];
    let corners = [0..VERTICES, 0..VERTICES, 0..VERTICES];
    (corners, 0.0..1.0_f64, 0.0..1.0_f64, place, view, any::<bool>()).prop_map(|(corners, a, b, place, view, below)| {
        let mut view = hemisphere(view);
        if below {
            view.z = -view.z;
        }
        ShadedPixel { corners, weights: [a, (1.0 - a) * b, (1.0 - a) * (1.0 - b)], place, view }
    })
}

proptest! {
    #[test]
    fn the_fast_lookup_gives_the_bits_of_the_reference(
        sizes in sizes(),
        values in prop::collection::vec(0.0..4.0_f32, 97),
        light in prop::collection::vec(0.0..9.0_f64, 3 * 9 * VERTICES as usize),
        pixel in pixel(),
    ) {
        let texture = texture(sizes, &values);
        let lights = sizes[1] * sizes[1];
        let local = &light.as_chunks().0[..lights * VERTICES as usize];
        let found = TextureLookup::new(&texture).radiance(local, &pixel, &mut Vec::new());
        prop_assert_eq!(found, reference::radiance(&texture, local, &pixel));
        // Light is linear: twice as much of it gives twice the radiance, to the bit.
        let twice: Vec<[f64; 3]> = local.iter().map(|rgb| rgb.map(|value| 2.0 * value)).collect();
        prop_assert_eq!(reference::radiance(&texture, &twice, &pixel), found.map(|value| 2.0 * value));
    }

    /// A texture that is the same everywhere gives its value times the light of the pixel, whatever place and view.
    #[test]
    fn weights_sum_to_one(sizes in sizes(), pixel in pixel(), value in 0.1..3.0_f32) {
        let texture = texture(sizes, &[value]);
        let lights = sizes[1] * sizes[1];
        let local = vec![[0.5, 1.0, 2.0]; lights * VERTICES as usize];
        for (found, light) in reference::radiance(&texture, &local, &pixel).into_iter().zip([0.5, 1.0, 2.0]) {
            assert_relative_eq!(found, light * f64::from(value) * lights as f64, max_relative = 1e-12);
        }
    }
}

/// At a vertex a pixel's frame is the vertex's own; between them it is right-handed and of length 1.
#[test]
fn frames_are_interpolated() {
    let vertices = Vertices::new(&hills(3), Tangents::Along(DVec3::X)).expect("vertices");
    for &corners in vertices.triangles() {
        for (at, weights) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().enumerate() {
            let (found, own) = (pixel_frame(&vertices, corners, weights), vertices.frames()[corners[at] as usize]);
            assert!(found.normal().distance(own.normal()) < 1e-14 && found.tangent().distance(own.tangent()) < 1e-14);
        }
        let between = pixel_frame(&vertices, corners, [0.2, 0.3, 0.5]).matrix();
        assert_relative_eq!(between.determinant(), 1.0, max_relative = 1e-12);
    }
}
