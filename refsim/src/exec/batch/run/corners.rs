//! Linear filtering: texels at the corners of a cell, their weights, weighted sums and interpolation.

use refsim_lanes::{LANES, LaneRow};

use super::address::AxisTaps;

/// Index of the border texel.
pub(super) const BORDER: u32 = u32::MAX;

/// Indices of the texels at the corners (bit `a` of a corner selects the second tap along axis `a`), offset by `face`
/// slices.
#[inline(always)]
pub(super) fn corner_numbers<const AXES: usize, const CORNERS: usize>(
    taps: &[AxisTaps; AXES],
    strides: [u32; 3],
    (face, slice): (&LaneRow, u32),
    out: &mut [LaneRow; CORNERS],
) {
    for (corner, out) in out.iter_mut().enumerate() {
        for i in 0..LANES {
            let (mut number, mut inside) = (face[i].wrapping_mul(slice), true);
            for axis in 0..AXES {
                let texel = taps[axis].texels[corner >> axis & 1][i];
                inside &= texel >= 0;
                number = number.wrapping_add(texel.cast_unsigned().wrapping_mul(strides[axis]));
            }
            out[i] = if inside { number } else { BORDER };
        }
    }
}

/// Weights of the corners, in units of `2^-(bits * AXES)`: integers of at most 36 bits.
#[inline(always)]
pub(super) fn corner_weights<const AXES: usize, const CORNERS: usize>(
    taps: &[AxisTaps; AXES],
    bits: u8,
    out: &mut [[f64; LANES]; CORNERS],
) {
    let one = 1i32 << bits;
    for (corner, out) in out.iter_mut().enumerate() {
        for (i, out) in out.iter_mut().enumerate() {
            let mut weight = 1.0;
            for (axis, taps) in taps.iter().enumerate() {
                let second = taps.weight[i];
                weight *= f64::from(if corner >> axis & 1 == 1 { second } else { one - second });
            }
            *out = weight;
        }
    }
}

/// Adds weights times numerators, in units of `unit`, a power of two. Weights sum to at most 2^36 and numerators have
/// 16 bits and a sign, so products and sums are integers of at most 2^52, exact in doubles, times a power of two.
#[inline(always)]
pub(super) fn add_weighted(numerators: &LaneRow, weights: &[f64; LANES], unit: f64, sum: &mut [f64; LANES]) {
    for i in 0..LANES {
        sum[i] += (weights[i] * unit) * f64::from(numerators[i].cast_signed());
    }
}

/// Interpolates singles at the corners along one axis after the other: `a + w (b - a)`, each step rounded, or `a`
/// itself if the weight is 0. A weight has at most 12 bits, so it is exact.
#[inline(always)]
pub(super) fn combine<const AXES: usize, const CORNERS: usize>(
    corners: &mut [LaneRow; CORNERS],
    taps: &[AxisTaps; AXES],
    bits: u8,
    out: &mut [f64; LANES],
) {
    let share = 1.0 / (1u32 << bits) as f32;
    let mut left = CORNERS;
    for taps in taps.iter().take(if CORNERS == 1 { 0 } else { AXES }) {
        left /= 2;
        for pair in 0..left {
            let (first, second) = (corners[2 * pair], corners[2 * pair + 1]);
            for (i, into) in corners[pair].iter_mut().enumerate() {
                let (a, b) = (f32::from_bits(first[i]), f32::from_bits(second[i]));
                let between = a + taps.weight[i] as f32 * share * (b - a);
                *into = (if taps.weight[i] == 0 { a } else { between }).to_bits();
            }
        }
    }
    for (out, &value) in out.iter_mut().zip(&corners[0]) {
        *out = f64::from(f32::from_bits(value));
    }
}

/// Interpolates bytes at the corners along one axis after the other.
#[inline(always)]
pub(super) fn combine_bytes<const AXES: usize, const CORNERS: usize>(
    corners: &mut [LaneRow; CORNERS],
    taps: &[AxisTaps; AXES],
    bits: u8,
    out: &mut [f64; LANES],
) {
    let mut left = CORNERS;
    for taps in taps.iter().take(if CORNERS == 1 { 0 } else { AXES }) {
        left /= 2;
        for pair in 0..left {
            let (first, second) = (corners[2 * pair], corners[2 * pair + 1]);
            for (i, into) in corners[pair].iter_mut().enumerate() {
                let [a, b] = [first[i], second[i]].map(u32::cast_signed);
                *into = byte_between(a, b, taps.weight[i], bits).cast_unsigned();
            }
        }
    }
    for (out, &value) in out.iter_mut().zip(&corners[0]) {
        *out = f64::from(value.cast_signed());
    }
}

/// Interpolates two bytes, to the nearest byte, halves up; the weight is in units of `2^-bits`.
#[inline(always)]
pub(super) fn byte_between(a: i32, b: i32, weight: i32, bits: u8) -> i32 {
    a + (((b - a) * weight + ((1 << bits) >> 1)) >> bits)
}
