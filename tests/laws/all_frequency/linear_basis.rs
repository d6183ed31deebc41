//! The linear basis: one light texel's weight at each fine direction, over all edges and corners of the cube.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crossbar::sphere::{CUBE_FACES, CubeMap};
use crossbar::transfer::grid::{
    FINE_DIRECTIONS, FINE_SIDE, FineDirections, LIGHT_SIDE, LIGHT_TEXELS, Segmentation, light_texel,
};
use crossbar::transfer::linear_basis::{BasisWeights, BasisWidth, LinearBasis};
use glam::{DMat3, DVec3};

use super::{close, texel_of};

const WIDTHS: [BasisWidth; 2] = [BasisWidth::OneTexel, BasisWidth::TwoTexels];

fn weights(width: BasisWidth, fine: usize) -> BTreeMap<usize, f64> {
    BasisWeights::of(width, fine).iter().collect()
}

fn direction(texel: usize, side: usize) -> DVec3 {
    CubeMap::new(side).direction(texel / (side * side), texel % side, texel / side % side)
}

/// At every fine direction, the weights are positive and sum to 1, and the texel that contains it has the largest.
#[test]
fn hats_are_a_partition_of_unity() {
    for width in WIDTHS {
        let mut counts = [0; 5];
        for fine in 0..FINE_DIRECTIONS {
            let found: Vec<(usize, f64)> = BasisWeights::of(width, fine).iter().collect();
            let sum: f64 = found.iter().map(|(_, weight)| weight).sum();
            assert!((sum - 1.0).abs() <= f64::EPSILON, "{width} {fine}: {sum}");
            assert_eq!(found[0].0, light_texel(fine));
            assert!(found.iter().all(|(_, weight)| *weight > 0.0 && *weight <= found[0].1), "{width} {fine}");
            // At most 7/8 of a texel along both axes; texels are largest at the middle of a face.
            let reach = 2.0_f64.sqrt() * 0.875 * 2.0 / LIGHT_SIDE as f64;
            let from = direction(fine, FINE_SIDE);
            let near = found.iter().all(|&(texel, _)| direction(texel, LIGHT_SIDE).distance(from) < reach);
            assert!(near, "{width} {fine}: texels around the direction");
            counts[found.len()] += 1;
        }
        // 2 x 2 fine directions at each of the 24 face corners have three texels; all others have four.
        let expected = if width == BasisWidth::OneTexel {
            [0, FINE_DIRECTIONS, 0, 0, 0]
        } else {
            [0, 0, 0, 96, FINE_DIRECTIONS - 96]
        };
        assert_eq!(counts, expected, "{width}");
    }
}

/// Symmetries of the cube map hat functions to hat functions, bit for bit; tests three generators of the 48 symmetries.
#[test]
fn hats_have_the_symmetry_of_the_cube() {
    let generators = [
        DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::Z),
        DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X),
        DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)),
    ];
    for turn in generators {
        for fine in (0..FINE_DIRECTIONS).filter(|fine| fine % FINE_SIDE < 8 || fine % 5 == 0) {
            let turned = texel_of(turn * direction(fine, FINE_SIDE), FINE_SIDE);
            let expected: BTreeMap<usize, f64> = weights(BasisWidth::TwoTexels, fine)
                .into_iter()
                .map(|(texel, weight)| (texel_of(turn * direction(texel, LIGHT_SIDE), LIGHT_SIDE), weight))
                .collect();
            assert_eq!(weights(BasisWidth::TwoTexels, turned), expected, "{fine} turned to {turned}");
        }
    }
}

/// Neighbors over an edge of the cube differ no more than neighbors within a face: a quarter of a texel moves a quarter
/// of the weights.
#[test]
fn hats_are_continuous_over_edges() {
    let change = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|fine| weights(BasisWidth::TwoTexels, fine));
        let texels = a.keys().chain(b.keys()).collect::<std::collections::BTreeSet<_>>();
        texels.into_iter().map(|texel| (a.get(texel).unwrap_or(&0.0) - b.get(texel).unwrap_or(&0.0)).abs()).sum::<f64>()
    };
    let step = 1.0 / FINE_SIDE as f64;
    let mut pairs = 0;
    for axes in CUBE_FACES {
        for (out, along) in [(axes.right, axes.down), (-axes.right, axes.down), (axes.down, axes.right)] {
            for k in 0..FINE_SIDE {
                let v = (2 * k + 1) as f64 * step - 1.0;
                let inside = texel_of(axes.center + (1.0 - step) * out + v * along, FINE_SIDE);
                let beyond = texel_of((1.0 - step) * axes.center + out + v * along, FINE_SIDE);
                assert_ne!(inside / (FINE_SIDE * FINE_SIDE), beyond / (FINE_SIDE * FINE_SIDE));
                assert!(change(inside, beyond) <= 0.5 + 1e-12, "{inside} {beyond}: {}", change(inside, beyond));
                pairs += 1;
            }
        }
    }
    assert_eq!(pairs, 6 * 3 * FINE_SIDE);
    close(change(20 * 128 + 18, 20 * 128 + 19), 0.5, 1e-12, "within a face");
}

/// A segment reaches its own directions and, with two-texel hats, also those just outside.
#[test]
fn segments_reach_half_a_texel_beyond_their_border() {
    let [one, two] = WIDTHS.map(LinearBasis::new);
    for segment in 0..Segmentation::Quarters.count() {
        let own: Vec<usize> = one.directions(segment).collect();
        let is_own = |fine: &usize| Segmentation::Quarters.place(light_texel(*fine))[0] == segment;
        assert!(own.len() == 64 * 64 && own.iter().all(is_own));
        let wide: Vec<usize> = two.directions(segment).collect();
        // 68 x 68, without the 2 x 2 beyond the cube's corner.
        assert_eq!(wide.len(), 68 * 68 - 4, "segment {segment}");
        assert!(wide.is_sorted() && own.iter().all(|fine| wide.binary_search(fine).is_ok()));
    }
    let whole: f64 = FineDirections::get().solid_angles().iter().sum();
    close(whole, 4.0 * PI, 1e-11, "the sphere");
    assert_eq!(LIGHT_TEXELS, 6144);
}
