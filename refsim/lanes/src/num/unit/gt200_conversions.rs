//! Conversions of GT200. Subnormal single floats count as zeros; subnormal half floats keep their value. There are four
//! roundings: to nearest even, down, up and toward zero; other roundings act as nearest even.

use super::gt200::nearest_even;
use super::word::{NAN, SIGN, Word, assemble, top24};
use crate::num::rules::Rounding;

/// `magnitude / 2^drop`, rounded to an integer.
fn divide(rounding: Rounding, negative: bool, magnitude: u128, drop: u32) -> u128 {
    let drop = drop.min(100);
    let cut = magnitude >> drop;
    let inexact = cut << drop != magnitude;
    match rounding {
        Rounding::TowardZero => cut,
        Rounding::Down | Rounding::Up => cut + u128::from(inexact && rounding.is_outward(negative)),
        _ => nearest_even(magnitude, drop),
    }
}

/// Returns `true` if magnitudes of a sign are never rounded up.
fn is_inward(rounding: Rounding, negative: bool) -> bool {
    rounding == Rounding::TowardZero
        || matches!(rounding, Rounding::Down | Rounding::Up) && !rounding.is_outward(negative)
}

/// Converts to a half float in four hexadecimal digits. Numbers below `2^-33` become zero in every rounding; NaN is
/// 7fff.
pub fn to_half(rounding: Rounding, x: u32) -> u32 {
    let word = Word::of(x);
    let half = match word.field {
        _ if word.is_nan() => return 0x7fff,
        255 => 0x7c00,
        ..94 => 0,
        field => {
            // Keeps 11 bits; subnormals are multiples of 2^-24.
            let least = (field - 112).max(1);
            let drop = (least + 125 - field).cast_unsigned();
            let steps = divide(rounding, word.negative, word.significand().into(), drop) as u32;
            // A carry, or the leading one of a normal number, increments the field.
            let pattern = steps + ((least - 1).cast_unsigned() << 10);
            match pattern {
                0x7c00.. if is_inward(rounding, word.negative) => 0x7bff,
                _ => pattern.min(0x7c00),
            }
        }
    };
    if word.negative { half | 0x8000 } else { half }
}

/// Rounds to an integer, as a float; zeros keep their sign.
pub fn round_to_int(rounding: Rounding, x: u32) -> u32 {
    let word = Word::of(x);
    match word.field {
        _ if word.is_nan() => NAN,
        0 => x & SIGN,
        150.. => x,
        field => {
            let drop = (150 - field).cast_unsigned();
            match divide(rounding, word.negative, word.significand().into(), drop) as u64 {
                0 => x & SIGN,
                whole => {
                    let (place, mantissa) = top24(whole);
                    assemble(word.negative, 127 + place, mantissa)
                }
            }
        }
    }
}

/// Rounds to an integer, clamped to 40 bits; `None` for NaN.
fn integer(rounding: Rounding, x: u32) -> Option<i64> {
    let word = Word::of(x);
    let magnitude = match word.field {
        _ if word.is_nan() => return None,
        0 => 0,
        field @ 150.. => word.significand() << (field - 150).min(16),
        field => divide(rounding, word.negative, word.significand().into(), (150 - field).cast_unsigned()) as u64,
    };
    let magnitude = magnitude.cast_signed();
    Some(if word.negative { -magnitude } else { magnitude })
}

/// Converts to a signed integer, clamped to its range; NaN gives 0.
pub fn to_signed(rounding: Rounding, x: u32) -> i32 {
    let value = integer(rounding, x).unwrap_or(0);
    value.clamp(i32::MIN.into(), i32::MAX.into()) as i32
}

/// Converts to an unsigned integer, clamped to its range; NaN gives 0.
pub fn to_unsigned(rounding: Rounding, x: u32) -> u32 {
    integer(rounding, x).unwrap_or(0).clamp(0, u32::MAX.into()) as u32
}

/// Converts from a signed integer, rounded once.
pub fn from_signed(rounding: Rounding, value: i32) -> u32 {
    from_magnitude(rounding, value < 0, value.unsigned_abs())
}

/// Converts from an unsigned integer, rounded once.
pub fn from_unsigned(rounding: Rounding, value: u32) -> u32 {
    from_magnitude(rounding, false, value)
}

fn from_magnitude(rounding: Rounding, negative: bool, magnitude: u32) -> u32 {
    if magnitude == 0 {
        return 0;
    }
    let drop = magnitude.ilog2().saturating_sub(23);
    let (place, mantissa) = top24(divide(rounding, negative, magnitude.into(), drop) as u64);
    assemble(negative, 127 + place + drop.cast_signed(), mantissa)
}
