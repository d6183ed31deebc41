//! Tests the ground truth's filter and tree against plain integers.

use crate::support::in_threads;
use crossbar::geom::exact::{self, ExactT, Guess, Sides, Tracer, filter, integer};
use crossbar::geom::{Mesh, Ray, aimed, teapot};
use num_bigint::BigUint;
use proptest::prelude::*;

/// Coordinates that often coincide: few values, some at the limits of the range.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => (-4_i8..=4).prop_map(f32::from),
        3 => (-64_i8..=64).prop_map(|value| f32::from(value) * 0.062_5),
        3 => -2.0_f32..2.0,
        1 => any::<f32>().prop_filter("finite", |value| value.is_finite()),
        1 => (0_u32..8, any::<bool>()).prop_map(|(bits, low)| if low { f32::from_bits(bits) } else { f32::from_bits(f32::MAX.to_bits() - bits) }),
    ]
}

fn vector() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3(coordinate())
}

fn triangle() -> impl Strategy<Value = [[f32; 3]; 3]> {
    prop::array::uniform3(vector())
}

fn sides() -> impl Strategy<Value = Sides> {
    prop_oneof![Just(Sides::Front), Just(Sides::Both)]
}

/// A random ray, or a ray toward a weighted sum of the corners: a corner, or a point on an edge, inside, or in the
/// plane.
fn ray_at(triangle: [[f32; 3]; 3]) -> impl Strategy<Value = Ray> {
    let weights = prop::array::uniform3(
        prop_oneof![2 => Just(0.0_f32), 2 => Just(1.0_f32), 1 => Just(0.5_f32), 2 => -0.5_f32..1.5],
    );
    (vector(), vector(), weights, 0_u8..5).prop_filter_map("a ray", move |(origin, free, weights, kind)| {
        let mix = |axis: usize| {
            let sum: f32 = weights.iter().sum();
            let total: f32 = (0..3).map(|corner| weights[corner] * triangle[corner][axis]).sum();
            if sum == 0.0 { triangle[0][axis] } else { total / sum }
        };
        let target = [mix(0), mix(1), mix(2)];
        let direction = match kind {
            0 => free,
            4 => [0, 1, 2].map(|axis| triangle[1][axis] - triangle[0][axis]),
            _ => [0, 1, 2].map(|axis| target[axis] - origin[axis]),
        };
        let origin = if kind == 4 { target } else { origin };
        Ray::new(origin, direction).ok()
    })
}

fn ray_and_triangle() -> impl Strategy<Value = (Ray, [[f32; 3]; 3])> {
    triangle().prop_flat_map(|triangle| (ray_at(triangle), Just(triangle)))
}

/// Meshes whose triangles share vertices, edges and planes.
fn mesh_and_ray() -> impl Strategy<Value = (Mesh, Ray)> {
    let mesh = prop::collection::vec(vector(), 3..9).prop_flat_map(|positions| {
        let index = 0..positions.len() as u32;
        let triangles = prop::collection::vec(prop::array::uniform3(index), 1..24);
        triangles.prop_map(move |triangles| Mesh::new(positions.clone(), triangles).expect("a mesh"))
    });
    mesh.prop_flat_map(|mesh| {
        let first = mesh.corners(0).expect("a triangle");
        (Just(mesh), ray_at(first))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_filter_agrees_with_integers((ray, triangle) in ray_and_triangle(), sides in sides()) {
        let truth = integer::intersect(&ray, &triangle, sides);
        match filter::guess(&ray, &triangle, sides) {
            Guess::Miss => prop_assert_eq!(&truth, &None),
            Guess::Hit { low, high } => {
                let t = truth.as_ref().expect("a hit");
                prop_assert!(fraction(low) <= *t && *t <= fraction(high), "{} not in [{}, {}]", t.to_f64(), low, high);
            }
            Guess::Unclear => {}
        }
        prop_assert_eq!(exact::intersect(&ray, &triangle, sides), truth);
    }

    #[test]
    fn a_reversed_triangle_shows_its_other_side((ray, triangle) in ray_and_triangle()) {
        let [a, b, c] = triangle;
        let front = integer::intersect(&ray, &triangle, Sides::Front);
        let back = integer::intersect(&ray, &[a, c, b], Sides::Front);
        prop_assert!(front.is_none() || back.is_none());
        prop_assert_eq!(integer::intersect(&ray, &triangle, Sides::Both), front.or(back));
        prop_assert_eq!(
            integer::intersect(&ray, &[b, c, a], Sides::Front),
            integer::intersect(&ray, &triangle, Sides::Front)
        );
    }

    #[test]
    fn t_rounds_as_division_does(num in any::<u32>(), den in 1_u32.., shift in 0_u16..200) {
        let t = ExactT::new(BigUint::from(num) << shift, BigUint::from(den) << shift).expect("a fraction");
        prop_assert_eq!(t.to_f64(), f64::from(num) / f64::from(den));
        let whole = ExactT::new(BigUint::from(num), BigUint::from(1_u8)).expect("a fraction");
        prop_assert_eq!(whole.to_f32(), num as f32);
        prop_assert_eq!(fraction(t.to_f64()).to_f64(), t.to_f64());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn every_path_finds_the_same_first_hit((mesh, ray) in mesh_and_ray(), sides in sides()) {
        let truth = integer::nearest(&mesh, &ray, sides);
        prop_assert_eq!(&exact::nearest(&mesh, &ray, sides), &truth);
        prop_assert_eq!(&Tracer::new(&mesh).nearest(&ray, sides), &truth);
        let hit = |(triangle, corners)| Some((exact::intersect(&ray, &corners, sides)?, triangle));
        let mut hits: Vec<(ExactT, u32)> = (0..).zip(mesh.iter_corners()).filter_map(hit).collect();
        hits.sort();
        prop_assert_eq!(hits.first().map(|hit| hit.1), truth.as_ref().map(|hit| hit.triangle));
        let ties = hits.iter().take_while(|hit| hit.0 == hits[0].0).map(|hit| hit.1);
        prop_assert_eq!(ties.collect::<Vec<_>>(), truth.map_or(Vec::new(), |hit| hit.ties));
    }
}

/// A finite, non-negative f64 as a fraction.
fn fraction(value: f64) -> ExactT {
    let (bits, field) = (value.to_bits(), value.to_bits() >> 52);
    let mantissa = bits & 0xf_ffff_ffff_ffff | u64::from(field > 0) << 52;
    ExactT::new(BigUint::from(mantissa) << field.max(1), BigUint::from(1_u8) << 1075_u16).expect("a fraction")
}

#[test]
fn threads_do_not_change_the_answer() {
    let mesh = teapot::teapot(3).expect("a teapot");
    let rays: Vec<Ray> = aimed::aimed_at_edges(&mesh, [2.9, -7.7, 5.3], 2, 5).iter().map(|aimed| aimed.ray).collect();
    let with = |threads| in_threads(threads, || exact::nearest_all(&mesh, &rays, Sides::Front));
    assert_eq!(with(1), with(2));
    assert_eq!(with(1), with(3));
}
