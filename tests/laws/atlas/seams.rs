//! No point of a face reads another face's texel: tests nearest and bilinear reads in integers.
//!
//! Weights of corners are multiples of 2^-K, so coordinates are multiples of 2^-K texels, and the arithmetic of reads
//! is exact.

use crossbar::atlas::{Atlas, DrawnFace, FacePlace};
use proptest::prelude::*;

use super::meshes::atlases;

const K: u32 = 6;
const ONE: i64 = 1 << K;

/// The coordinates of the point with these weights, in units of 2^-K texels, interpolated over the drawn triangle that
/// contains it.
fn drawn_at(drawn: &DrawnFace, place: &FacePlace, weights: [i64; 3]) -> [i64; 2] {
    let [a, b, c] = place.in_turn(weights);
    // m = (b + c) / 2.
    let (triangle, of) = if b >= c { (0, [a, b - c, 2 * c]) } else { (1, [a, 2 * b, c - b]) };
    [0, 1].map(|axis| {
        let corners = drawn.triangles[triangle].iter().zip(of);
        corners.map(|(vertex, weight)| i64::from(vertex.at[axis]) * weight).sum()
    })
}

/// The coordinates of a point over the whole face: on each axis the smaller of two interpolated coordinates.
fn whole_at(drawn: &DrawnFace, weights: [i64; 3]) -> [i64; 2] {
    let at = |pair: usize, axis: usize| {
        let vertices = drawn.whole.iter().zip(weights);
        vertices.map(|(vertex, weight)| i64::from(vertex.at[pair][axis]) * weight).sum::<i64>()
    };
    [0, 1].map(|axis| at(0, axis).min(at(1, axis)))
}

/// Coordinates clamped to the bounds, as a program clamps them.
fn clamped(drawn: &DrawnFace, at: [i64; 2]) -> [i64; 2] {
    let bound = |index: usize| (drawn.bounds[index] * ONE as f64) as i64;
    [0, 1].map(|axis| at[axis].clamp(bound(axis), bound(axis + 2)))
}

/// The texels with a non-zero weight in a bilinear read.
fn bilinear([x, y]: [i64; 2]) -> Vec<[i64; 2]> {
    let along = |at: i64| {
        let low = (at - ONE / 2).div_euclid(ONE);
        let weight = (at - ONE / 2).rem_euclid(ONE);
        [(low, ONE - weight), (low + 1, weight)]
    };
    let pairs = along(x).into_iter().flat_map(|x| along(y).map(|y| (x, y)));
    pairs.filter(|(x, y)| x.1 * y.1 > 0).map(|(x, y)| [x.0, y.0]).collect()
}

/// Weights of points all over a face: its corners, along its edges, and inside.
fn all_over() -> impl Iterator<Item = [i64; 3]> {
    let steps = [0, 1, 2, 3, 8, 21, 31, 32, 33, 43, 56, 61, 62, 63, 64];
    steps.into_iter().flat_map(move |a| steps.map(|b| [a, b, ONE - a - b])).filter(|weights| weights[2] >= 0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_point_reads_another_faces_texel((sample, side) in atlases()) {
        let atlas = Atlas::new(&sample.mesh, side).expect("an atlas");
        for (face, place) in (0..).zip(atlas.places()) {
            let drawn = atlas.drawn(face);
            let owner = |[x, y]: [i64; 2]| {
                let inside = (0..i64::from(side)).contains(&x) && (0..i64::from(side)).contains(&y);
                inside.then(|| atlas.texels()[(y * i64::from(side) + x) as usize].face)
            };
            for weights in all_over() {
                let at = drawn_at(&drawn, place, weights);
                let told = atlas.coordinates(face, weights.map(|weight| weight as f64 / ONE as f64));
                prop_assert_eq!(at.map(|at| at as f64 / ONE as f64), told, "the same map, drawn and computed");
                prop_assert_eq!(at, whole_at(&drawn, weights), "and drawn whole");
                let read = clamped(&drawn, at);
                let nearest = read.map(|at| at.div_euclid(ONE));
                prop_assert_eq!(owner(nearest), Some(face), "nearest, {:?}", weights);
                for texel in bilinear(read) {
                    prop_assert_eq!(owner(texel), Some(face), "bilinear, {:?}", weights);
                }
            }
        }
    }

    /// The two drawn triangles cover the center of each texel of the face once: the center is inside one triangle, or
    /// on the diagonal, which the fill rule assigns to one of them.
    #[test]
    fn drawing_covers_the_rectangle((sample, side) in atlases()) {
        let atlas = Atlas::new(&sample.mesh, side).expect("an atlas");
        for (face, place) in (0..).zip(atlas.places()) {
            let drawn = atlas.drawn(face);
            for y in place.y..place.y + place.height {
                for x in place.x..place.x + place.width {
                    // In half texels.
                    let center = [2 * i64::from(x) + 1, 2 * i64::from(y) + 1];
                    let [one, other] = drawn.triangles.map(|triangle| {
                        let at = triangle.map(|vertex| vertex.at.map(|at| 2 * i64::from(at)));
                        let side = |p: [i64; 2], q: [i64; 2]| {
                            (q[0] - p[0]) * (center[1] - p[1]) - (q[1] - p[1]) * (center[0] - p[0])
                        };
                        let sides = [side(at[0], at[1]), side(at[1], at[2]), side(at[2], at[0])];
                        (sides.iter().all(|s| *s > 0) || sides.iter().all(|s| *s < 0), sides.contains(&0))
                    });
                    prop_assert!(one.0 ^ other.0 || (one.1 && other.1), "{x} {y} {:?}", place);
                }
            }
            let [x, y, far_x, far_y] = drawn.bounds;
            prop_assert!(x <= far_x && y <= far_y);
        }
    }
}
