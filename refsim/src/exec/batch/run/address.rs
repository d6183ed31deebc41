//! Texture addressing in rows: converts coordinates to texel indices and filter weights, in double precision, in which
//! every step is exact.

use refsim_lanes::{LANES, LaneRow};

use crate::texture::{AddressMode, WeightRounding};

/// Larger coordinates are even integers with the same address, so they are clamped to this one.
const FAR: f64 = 16_777_216.0;

/// An axis of a mip level.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TexelAxis {
    pub(crate) size: u32,
    /// Texels per unit of the coordinate.
    pub(crate) scale: f64,
    pub(crate) mode: AddressMode,
}

/// Fraction bits of filter weights, and their rounding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights {
    pub(crate) bits: u8,
    pub(crate) rounding: WeightRounding,
}

/// The two texels of linear filtering along an axis (-1 for the border), and the weight of the second texel in units of
/// the filter's fraction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisTaps {
    pub(crate) texels: [[i32; LANES]; 2],
    pub(crate) weight: [i32; LANES],
}

impl AxisTaps {
    pub(crate) const ZERO: Self = Self { texels: [[0; LANES]; 2], weight: [0; LANES] };
}

/// Texel indices along an axis with nearest filtering; -1 for the border.
///
/// Exact in double precision: the product has 24 + 15 bits, and the quotient of a position below 2^39 and a size below
/// 2^15 is never rounded up to an integer.
#[inline(always)]
pub(crate) fn nearest(coordinate: &LaneRow, axis: TexelAxis, out: &mut [i32; LANES]) {
    let (n, scale) = (f64::from(axis.size), axis.scale);
    match axis.mode {
        AddressMode::Clamp if scale == 1.0 => clamped(coordinate, axis.size, out),
        AddressMode::Wrap => each(coordinate, scale, out, |p| wrap(p, n)),
        AddressMode::Mirror => each(coordinate, scale, out, |p| mirror(p, n)),
        AddressMode::Clamp => each(coordinate, scale, out, |p| clamp(p, n)),
        AddressMode::Border => each(coordinate, scale, out, |p| border(p, n)),
    }
}

/// Texels and weight of linear filtering along an axis, with at most 12 fraction bits of the weight. Without fraction
/// bits the first texel is the nearest texel, and all weights are 0.
///
/// The position in units of the filter is `floor(p + 1/2) - 2^(bits-1)`, `p = coordinate scale 2^bits`; without the 1/2
/// if weights are truncated. In double precision:
///
/// - p has 24 + 15 bits and is at most 2^(24 + 14 + 12): the product is exact.
/// - From 2^-13 on the last bit of p is at least 2^-52, and below 2^51 one half is no less than the last bit of the
///   sum's double: `p + 1/2` is exact. For a smaller p the sum has an error of at most 2^-54; both it and the exact sum
///   are between 0 and 1, so both floors are 0.
/// - The other operands are integers of at most 2^51 and powers of two. For the address modes see [`nearest`].
#[inline(always)]
pub(crate) fn linear(coordinate: &LaneRow, axis: TexelAxis, weights: Weights, out: &mut AxisTaps) {
    let n = f64::from(axis.size);
    match axis.mode {
        AddressMode::Wrap => each_tap(coordinate, axis.scale, weights, out, |p| wrap(p, n)),
        AddressMode::Mirror => each_tap(coordinate, axis.scale, weights, out, |p| mirror(p, n)),
        AddressMode::Clamp => each_tap(coordinate, axis.scale, weights, out, |p| clamp(p, n)),
        AddressMode::Border => each_tap(coordinate, axis.scale, weights, out, |p| border(p, n)),
    }
}

/// Texel indices along a clamped axis of a rectangle: coordinates are positions, and every step is exact in single
/// precision.
#[inline(always)]
fn clamped(coordinate: &LaneRow, size: u32, out: &mut [i32; LANES]) {
    // Less than 2^24, so exact.
    let last = (size - 1) as f32;
    for i in 0..LANES {
        let c = f32::from_bits(coordinate[i]);
        let finite = if c.abs() < f32::INFINITY { c } else { 0.0 };
        let above = if finite > 0.0 { finite } else { 0.0 };
        // Between 0 and the last texel, where truncation rounds down.
        out[i] = (if above < last { above } else { last }) as i32;
    }
}

/// Texel indices from a coordinate's position in texels, rounded down.
#[inline(always)]
fn each(coordinate: &LaneRow, scale: f64, out: &mut [i32; LANES], number: impl Fn(f64) -> f64) {
    for i in 0..LANES {
        out[i] = number((tamed(coordinate[i]) * scale).floor()) as i32;
    }
}

#[inline(always)]
fn each_tap(coordinate: &LaneRow, scale: f64, weights: Weights, out: &mut AxisTaps, number: impl Fn(f64) -> f64) {
    let one = f64::from(1u32 << weights.bits);
    let back = if weights.bits == 0 { 0.0 } else { 0.5 * one };
    let up = if weights.bits == 0 || weights.rounding == WeightRounding::Cut { 0.0 } else { 0.5 };
    let (scale, share) = (scale * one, 1.0 / one);
    let AxisTaps { texels: [first, second], weight } = out;
    for i in 0..LANES {
        let position = (tamed(coordinate[i]) * scale + up).floor() - back;
        let whole = (position * share).floor();
        weight[i] = (position - whole * one) as i32;
        first[i] = number(whole) as i32;
        second[i] = number(whole + 1.0) as i32;
    }
}

/// Replaces a coordinate by a bounded one with the same address; NaN and infinities address as 0.
#[inline(always)]
fn tamed(coordinate: u32) -> f64 {
    let c = f64::from(f32::from_bits(coordinate));
    let finite = if c.abs() < f64::INFINITY { c } else { 0.0 };
    let low = if finite > -FAR { finite } else { -FAR };
    if low < FAR { low } else { FAR }
}

#[inline(always)]
fn wrap(p: f64, n: f64) -> f64 {
    p - (p / n).floor() * n
}

#[inline(always)]
fn mirror(p: f64, n: f64) -> f64 {
    let folded = p - (p / (2.0 * n)).floor() * (2.0 * n);
    if folded < n { folded } else { 2.0 * n - 1.0 - folded }
}

#[inline(always)]
fn clamp(p: f64, n: f64) -> f64 {
    let above = if p > 0.0 { p } else { 0.0 };
    if above < n - 1.0 { above } else { n - 1.0 }
}

#[inline(always)]
fn border(p: f64, n: f64) -> f64 {
    if (p >= 0.0) & (p < n) { p } else { -1.0 }
}

/// Cube face that each direction selects, in the order of slices, and the coordinates on it, in single-precision steps.
/// NaN and infinite components count as 0.
#[inline(always)]
pub(crate) fn cube([x, y, z]: [&LaneRow; 3], face: &mut LaneRow, [u, v]: [&mut LaneRow; 2]) {
    let finite = |bits: u32| if bits & 0x7f80_0000 == 0x7f80_0000 { 0 } else { bits };
    let (size, flip) = (|c: u32| c & 0x7fff_ffff, |c: u32| c ^ 0x8000_0000);
    let place = |c: u32, m: u32| ((f32::from_bits(c) / f32::from_bits(m) + 1.0) * 0.5).to_bits();
    for i in 0..LANES {
        let [x, y, z] = [finite(x[i]), finite(y[i]), finite(z[i])];
        let below = |c: u32| c >> 31;
        // If magnitudes are equal, the last axis is selected.
        let of_x = (below(x), if below(x) == 1 { z } else { flip(z) }, flip(y), size(x));
        let of_y = (2 + below(y), x, if below(y) == 1 { flip(z) } else { z }, size(y));
        let of_z = (4 + below(z), if below(z) == 1 { flip(x) } else { x }, flip(y), size(z));
        let side = if size(y) >= size(x) { of_y } else { of_x };
        let chosen = if (size(z) >= size(y)) & (size(z) >= size(x)) { of_z } else { side };
        face[i] = chosen.0;
        u[i] = place(chosen.1, chosen.3);
        v[i] = place(chosen.2, chosen.3);
    }
}
