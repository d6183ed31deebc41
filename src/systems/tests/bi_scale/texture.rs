//! Patches of heights, textures of samples, and the samples around a position.

use approx::assert_abs_diff_eq;
use crossbar_systems::bi_scale::texture::{BidirectionalTexture, GridSamples, HeightField, PatchKind};
use glam::DVec3;

use super::directions;

#[test]
fn heights_stand_at_the_middles_of_texels_and_repeat() {
    let field = HeightField::new(2, &[1.0, 0.5, 0.25, 0.0]).unwrap();
    let at = |u: f64, v: f64| field.height([u, v]);
    assert_eq!([at(0.25, 0.25), at(0.75, 0.25), at(0.25, 0.75), at(0.75, 0.75)], [0.0, -0.5, -0.75, -1.0]);
    assert_eq!((at(-0.75, 2.25), field.depth()), (at(0.25, 0.25), 1.0));
    assert_eq!([at(0.5, 0.25), at(0.0, 0.25), at(0.5, 0.5)], [-0.25, -0.25, -0.5625]);
    // The surface falls by half an edge over half an edge: 45 degrees.
    let normal = field.normal([0.5, 0.25]);
    assert_abs_diff_eq!(normal.x / normal.z, 1.0, epsilon = 1e-15);
    assert_eq!(HeightField::flat().normal([0.3, 0.9]), DVec3::Z);
}

#[test]
fn heights_out_of_range_are_refused() {
    let text = [
        HeightField::new(0, &[]),
        HeightField::new(2, &[0.0; 3]),
        HeightField::new(2, &[0.0, 1.0, f64::NAN, 0.0]),
        HeightField::new(1, &[f64::INFINITY]),
        HeightField::new(2, &[0.0, 0.0, 0.0, -17.0]),
    ]
    .map(|made| made.unwrap_err().to_string());
    insta::assert_snapshot!(text.join("\n"), @"
    expected 1 to 1024 texels along an edge of the heights, found 0
    expected 4 heights, 2 x 2, found 3
    expected finite heights, the lowest at most 16 edges of the patch below the highest; found NaN in row 1, column 0
    expected finite heights, the lowest at most 16 edges of the patch below the highest; found inf in row 0, column 0
    expected finite heights, the lowest at most 16 edges of the patch below the highest; found -17 in row 1, column 1
    ");
}

#[test]
fn patches_have_a_relief_and_it_can_be_taken_away() {
    for kind in PatchKind::ALL {
        let patch = kind.patch(1.0);
        let depth = patch.heights().depth();
        assert!((0.02..0.25).contains(&depth), "{kind}: {depth}");
        assert_eq!(kind.patch(0.0).heights().depth().to_bits(), 0, "not -0, which is printed");
        assert!((kind.patch(2.0).heights().depth() - 2.0 * depth).abs() < 1e-12);
    }
}

#[test]
fn samples_stand_where_their_numbers_say() {
    let samples: Vec<[f32; 3]> = (0..4 * 9 * 25).map(|at| [at as f32; 3]).collect();
    let texture = BidirectionalTexture::new(5, directions(2), directions(3), samples).unwrap();
    assert_eq!(texture.patch(3, 7)[2 * 5 + 4], [((3 * 9 + 7) * 25 + 14) as f32; 3]);
}

#[test]
fn samples_out_of_range_are_refused() {
    let of = |size, count, value: f32| {
        BidirectionalTexture::new(size, directions(1), directions(2), vec![[value; 3]; count]).unwrap_err()
    };
    let all = directions(64);
    let huge = PatchKind::Tiles.patch(1.0).texture(1024, &all, &all, &mut |_, _| ()).unwrap_err();
    let errors = [of(0, 0, 1.0), of(2, 15, 1.0), of(2, 16, -1.0), of(2, 16, f32::NAN), huge];
    let text = errors.map(|error| error.to_string());
    insta::assert_snapshot!(text.join("\n"), @"
    expected a patch of 1 to 1024 texels along an edge, found 0
    expected 16 samples (1 views x 4 lights x 2 x 2 texels), found 15
    expected finite samples of 0 or more, found another number at view 0, light 0, row 0, column 0
    expected finite samples of 0 or more, found another number at view 0, light 0, row 0, column 0
    expected at most 715827882 samples, found 17592186044416 (4096 views x 4096 lights x 1024 x 1024 texels)
    ");
}

#[test]
fn a_center_has_its_own_sample_alone_and_weights_sum_to_1() {
    let view = directions(12);
    for (number, &direction) in view.directions().iter().enumerate() {
        let found = GridSamples::of_view(&view, direction);
        let own: f64 = found.numbers.iter().zip(found.weights).filter(|(n, _)| **n == number).map(|(_, w)| w).sum();
        assert_abs_diff_eq!(own, 1.0, epsilon = 1e-6);
        assert_abs_diff_eq!(found.weights.iter().sum::<f64>(), 1.0, epsilon = 1e-12);
    }
    let horizon = GridSamples::of_view(&view, DVec3::new(1.0, 0.0, -0.5).normalize());
    assert!(horizon.numbers.iter().all(|number| number % 12 == 11));
    assert_eq!(GridSamples::of_view(&directions(1), DVec3::Z).numbers, [0; 4]);
}

#[test]
fn texels_repeat() {
    let at = |place| GridSamples::of_texels(4, place);
    assert_eq!(at([0.375, 0.625]), GridSamples { numbers: [9, 10, 13, 14], weights: [1.0, 0.0, 0.0, 0.0] });
    assert_eq!(at([0.0, 0.125]).numbers, [3, 0, 7, 4]);
    assert_eq!(at([0.0, 0.125]).weights, [0.5, 0.5, 0.0, 0.0]);
    assert_eq!(at([2.25, -0.75]), at([0.25, 0.25]));
    assert_eq!(GridSamples::of_texels(1, [0.9, 0.1]).numbers, [0; 4]);
}
