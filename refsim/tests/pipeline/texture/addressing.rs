//! Texture addressing.

use super::rational::Rational;
use num_bigint::BigInt;
use proptest::prelude::*;
use refsim::texture::{AddressMode, CubeFace, WeightRounding, cube_coordinates, linear_taps, nearest_index};

pub(crate) const MODES: [AddressMode; 4] =
    [AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border];

/// Naive addressing: moves into the image step by step. `position` must be small.
pub(crate) fn naive(mode: AddressMode, position: i64, size: i64) -> Option<u32> {
    let mut p = position;
    match mode {
        AddressMode::Wrap => {
            while p < 0 {
                p += size;
            }
            while p >= size {
                p -= size;
            }
        }
        AddressMode::Mirror => {
            // Reflect at the nearer edge until inside.
            while !(0..size).contains(&p) {
                p = if p < 0 { -1 - p } else { 2 * size - 1 - p };
            }
        }
        AddressMode::Clamp => {
            p = if p < 0 {
                0
            } else if p >= size {
                size - 1
            } else {
                p
            }
        }
        AddressMode::Border if !(0..size).contains(&p) => return None,
        AddressMode::Border => {}
    }
    Some(p as u32)
}

/// `u * n - offset`, exact, floored to units of 1/scale, after reducing huge coordinates.
fn position(u: f32, n: u32, scale: i64, halves: i64) -> BigInt {
    let exact =
        Rational::of_f32(u).mul(&Rational::new(n, 1)).add(&Rational::new(halves, 2)).mul(&Rational::new(scale, 1));
    exact.floor()
}

fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        -4.0f32..4.0,
        (-64i32..64, 1u32..2048).prop_map(|(i, n)| i as f32 / n as f32),
        -1e-3f32..1e-3,
        (0i32..64, 1u32..64).prop_map(|(i, n)| (i as f32 + 0.5) / n as f32),
        prop::num::f32::SUBNORMAL,
        prop::sample::select(vec![-0.0, f32::from_bits(0x8000_0001), 1.0 - f32::EPSILON / 2.0, 1.0]),
    ]
}

proptest! {
    #[test]
    fn nearest_matches_the_naive_model(u in coordinate(), n in 1u32..3000) {
        let p = i64::try_from(position(u, n, 1, 0)).unwrap();
        for mode in MODES {
            prop_assert_eq!(nearest_index(mode, u.to_bits(), n, n), naive(mode, p, i64::from(n)), "{:?} {}", mode, u);
        }
    }

    #[test]
    fn linear_taps_match_the_naive_model(u in coordinate(), n in 1u32..3000, bits in 0u8..=12, cut in any::<bool>()) {
        // round(x) with ties up is floor(x + 1/2) in units of the grid.
        let one = 1i64 << bits;
        let doubled: BigInt = position(u, n, 2 * one, -1) + i32::from(!cut || bits == 0);
        let p = i64::try_from(doubled).unwrap().div_euclid(2);
        let rounding = WeightRounding::ALL[usize::from(cut)];
        let whole = p.div_euclid(one);
        for mode in MODES {
            let (taps, weight) = linear_taps(mode, u.to_bits(), n, n, bits, rounding);
            prop_assert_eq!(weight, p.rem_euclid(one) as u32);
            prop_assert_eq!(taps, [naive(mode, whole, i64::from(n)), naive(mode, whole + 1, i64::from(n))]);
        }
    }

    /// Coordinates of any magnitude address the texel that exact arithmetic finds.
    #[test]
    fn huge_coordinates_are_addressed_exactly(bits in any::<u32>(), n in 1u32..5000) {
        let u = f32::from_bits(bits);
        prop_assume!(u.is_finite());
        let p = position(u, n, 1, 0);
        let fold = |p: &BigInt, m: i64| i64::try_from(((p % m) + m) % m).unwrap();
        prop_assert_eq!(nearest_index(AddressMode::Wrap, bits, n, n), Some(fold(&p, i64::from(n)) as u32));
        let clamped = p.clone().clamp(BigInt::from(0), BigInt::from(n - 1));
        let outside = p != clamped;
        prop_assert_eq!(nearest_index(AddressMode::Clamp, bits, n, n), Some(u32::try_from(clamped).unwrap()));
        prop_assert_eq!(nearest_index(AddressMode::Border, bits, n, n).is_none(), outside);
        prop_assert_eq!(nearest_index(AddressMode::Mirror, bits, n, n), naive(AddressMode::Mirror, fold(&p, 2 * i64::from(n)), i64::from(n)));
    }
}

/// (i + 1/2) / n, rounded to FP32, is in texel i: data textures can be addressed by index.
#[test]
fn texel_centres_address_their_texel_up_to_2048() {
    for n in 1..=2048u32 {
        for i in 0..n {
            let u = (i as f32 + 0.5) / n as f32;
            assert_eq!(nearest_index(AddressMode::Clamp, u.to_bits(), n, n), Some(i), "{i} of {n}");
        }
    }
}

#[test]
fn rectangles_are_addressed_in_texels() {
    for (u, index) in [(0.0f32, 0), (0.99, 0), (1.0, 1), (6.5, 6), (7.0, 6), (-3.0, 0)] {
        assert_eq!(nearest_index(AddressMode::Clamp, u.to_bits(), 7, 1), Some(index), "{u}");
    }
    assert_eq!(nearest_index(AddressMode::Wrap, f32::NAN.to_bits(), 2048, 2048), Some(0));
}

/// The Direct3D table: for each face, the directions of its center, of increasing u and of increasing v.
#[test]
fn cube_faces_follow_the_table() {
    let table = [
        (CubeFace::PositiveX, [1., 0., 0.], [0., 0., -1.], [0., -1., 0.]),
        (CubeFace::NegativeX, [-1., 0., 0.], [0., 0., 1.], [0., -1., 0.]),
        (CubeFace::PositiveY, [0., 1., 0.], [1., 0., 0.], [0., 0., 1.]),
        (CubeFace::NegativeY, [0., -1., 0.], [1., 0., 0.], [0., 0., -1.]),
        (CubeFace::PositiveZ, [0., 0., 1.], [1., 0., 0.], [0., -1., 0.]),
        (CubeFace::NegativeZ, [0., 0., -1.], [-1., 0., 0.], [0., -1., 0.]),
    ];
    for (slice, (face, centre, along_u, along_v)) in table.into_iter().enumerate() {
        assert_eq!(face as usize, slice);
        for (du, dv) in [(0.0f32, 0.0f32), (0.5, 0.0), (0.0, 0.5), (-0.75, 0.25)] {
            for length in [1.0f32, 3.0, 1e-30] {
                let d: [f32; 3] = std::array::from_fn(|i| (centre[i] + du * along_u[i] + dv * along_v[i]) * length);
                let (found, u, v) = cube_coordinates(d.map(f32::to_bits));
                let (u, v) = (f32::from_bits(u), f32::from_bits(v));
                assert_eq!(found, face, "{d:?}");
                assert!((u - (du + 1.0) / 2.0).abs() < 1e-6 && (v - (dv + 1.0) / 2.0).abs() < 1e-6, "{d:?}: {u} {v}");
            }
        }
    }
    // On ties, z precedes y and y precedes x.
    let face = |d: [f32; 3]| cube_coordinates(d.map(f32::to_bits)).0;
    assert_eq!(face([1., 1., 1.]), CubeFace::PositiveZ);
    assert_eq!(face([-1., -1., 0.]), CubeFace::NegativeY);
    assert_eq!(face([1., 0., -1.]), CubeFace::NegativeZ);
}
