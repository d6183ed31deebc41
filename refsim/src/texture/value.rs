//! Exact values of bit patterns, and the FP32 operations shared by the fixed-function stages.
//!
//! The modules texture, raster and output use [`crate::num`] only through these FP32 operations.

use crate::num::{self, Format};

pub(crate) const ZERO: u32 = 0;
pub(crate) const ONE: u32 = 0x3f80_0000;
pub(crate) const HALF: u32 = 0x3f00_0000;
pub(crate) const NAN: u32 = 0x7fc0_0000;

pub(crate) fn add(a: u32, b: u32) -> u32 {
    num::ops::add(Format::FP32, a, b).bits
}

pub(crate) fn sub(a: u32, b: u32) -> u32 {
    num::ops::sub(Format::FP32, a, b).bits
}

pub(crate) fn mul(a: u32, b: u32) -> u32 {
    num::ops::mul(Format::FP32, a, b).bits
}

pub(crate) fn div(a: u32, b: u32) -> u32 {
    num::ops::div(Format::FP32, a, b).bits
}

/// Returns `true` if an FP32 pattern is a NaN or an infinity.
pub(crate) fn is_not_finite(bits: u32) -> bool {
    bits & 0x7f80_0000 == 0x7f80_0000
}

/// Returns `true` if an FP32 pattern is a NaN.
pub(crate) fn is_nan(bits: u32) -> bool {
    bits & 0x7fff_ffff > 0x7f80_0000
}

/// Replaces infinities and NaN by 0.
pub(crate) fn finite_or_zero(bits: u32) -> u32 {
    if is_not_finite(bits) { ZERO } else { bits }
}

/// Returns `true` if the FP32 pattern is below zero (-0 and NaN are not).
pub(crate) fn is_negative(bits: u32) -> bool {
    bits > 0x8000_0000 && !is_nan(bits)
}

/// A key that orders finite FP32 patterns by value; both zeros have the same key.
pub(crate) fn order_key(bits: u32) -> i64 {
    let magnitude = i64::from(bits & 0x7fff_ffff);
    if bits >> 31 == 1 { -magnitude } else { magnitude }
}

/// Converts an integer to FP32, rounded to nearest, ties to even, like the host's `as f32`.
pub(crate) fn from_integer(value: i64) -> u32 {
    if value == 0 {
        return ZERO;
    }
    let sign = if value < 0 { 0x8000_0000 } else { 0 };
    let magnitude = value.unsigned_abs();
    let top = 63 - magnitude.leading_zeros();
    let mut significand = if top <= 23 {
        magnitude << (23 - top)
    } else {
        let shift = top - 23;
        let (kept, rest, half) = (magnitude >> shift, magnitude & ((1 << shift) - 1), 1u64 << (shift - 1));
        kept + u64::from(rest > half || (rest == half && kept & 1 == 1))
    };
    let mut exponent = top + 127;
    if significand == 1 << 24 {
        significand >>= 1;
        exponent += 1;
    }
    sign | (exponent << 23) | (significand as u32 & 0x007f_ffff)
}

/// Exact value of a bit pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exact {
    /// Not a number.
    Nan,
    Infinite {
        /// Below zero.
        negative: bool,
    },
    /// `significand * 2^exponent / denominator`
    Finite {
        /// Below zero (or -0).
        negative: bool,
        /// At most 32 bits.
        significand: u64,
        /// Power of two.
        exponent: i32,
        /// 1, except for numbers of normalized formats.
        denominator: u32,
    },
}

/// Decodes a pattern of any format exactly.
pub(crate) fn exact(format: Format, bits: u32) -> Exact {
    match num::unpack(&format, bits) {
        num::Unpacked::Nan { .. } => Exact::Nan,
        num::Unpacked::Inf { sign } => Exact::Infinite { negative: sign },
        num::Unpacked::Finite { sign, sig, exp, den } => {
            Exact::Finite { negative: sign, significand: sig, exponent: exp, denominator: den }
        }
    }
}

pub(crate) fn exact32(bits: u32) -> Exact {
    let negative = bits >> 31 == 1;
    let field = (bits >> 23 & 0xff).cast_signed();
    let fraction = u64::from(bits & 0x007f_ffff);
    match field {
        255 if fraction != 0 => Exact::Nan,
        255 => Exact::Infinite { negative },
        0 => Exact::Finite { negative, significand: fraction, exponent: -149, denominator: 1 },
        _ => {
            let significand = fraction | 0x0080_0000;
            Exact::Finite { negative, significand, exponent: field - 150, denominator: 1 }
        }
    }
}

/// Computes `floor(value * factor * 2^fraction_bits)` of a finite FP32 pattern; if `round`, rounds to nearest, halves
/// up.
///
/// `factor` is at most 2^16 and `fraction_bits` at most 16; results saturate at 2^62 in magnitude.
pub(crate) fn scaled_floor(bits: u32, factor: u32, fraction_bits: u32, round: bool) -> i64 {
    let Exact::Finite { negative, significand, exponent, .. } = exact32(bits) else {
        return 0;
    };
    if significand == 0 {
        return 0;
    }
    let product = i128::from(significand) * i128::from(factor);
    let signed = if negative { -product } else { product };
    // One extra fraction bit, so that a half can be added before the floor.
    let shift = exponent + fraction_bits.cast_signed() + 1;
    let doubled = if shift >= 0 {
        if shift > 64 { signed.signum() << 100 } else { signed << shift }
    } else if shift < -120 {
        signed >> 120
    } else {
        signed >> -shift
    };
    let result = (doubled + i128::from(round)) >> 1;
    result.clamp(-(1 << 62), 1 << 62) as i64
}

/// Rounds `significand * 2^exponent / denominator * scale` to an integer, at most `scale`.
///
/// Halves round away from zero if `nearest`; otherwise the fraction is truncated.
pub(crate) fn scaled_magnitude(significand: u64, exponent: i32, denominator: u32, scale: u64, nearest: bool) -> u64 {
    let product = u128::from(significand) * u128::from(scale);
    let shift = exponent.min(0).unsigned_abs();
    if shift > 100 {
        return 0;
    }
    // Counts halves of a step; the last bit decides the rounding.
    let halves = if denominator == 1 {
        (product << (1 + exponent.clamp(0, 40))) >> shift
    } else {
        // Normalized numbers have no exponents.
        2 * product / u128::from(denominator)
    };
    ((halves + u128::from(nearest)) / 2).min(u128::from(scale)) as u64
}

/// `value / 2^bits` as FP32; exact for magnitudes below 2^24 and `bits` at most 16.
pub(crate) fn from_fixed(value: i64, bits: u8) -> u32 {
    if value == 0 { ZERO } else { from_integer(value) - (u32::from(bits) << 23) }
}

/// Rounds `numerator / denominator` once into `format`.
pub(crate) fn ratio(format: Format, numerator: i64, denominator: u64) -> u32 {
    num::from_ratio(format, numerator < 0, u128::from(numerator.unsigned_abs()), u128::from(denominator)).bits
}
