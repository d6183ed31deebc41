//! Enclosures of `2^f` and `log2 m`, fast in machine words and with arbitrary precision, and of sine and cosine.
//!
//! Every step truncates, so the lower end is a lower bound; the upper end adds the bound on the truncation error that
//! each function states.

use num_bigint::{BigInt, BigUint};

use super::series;

/// A value strictly between `low * 2^exp` and `high * 2^exp`, with `high - low` at least 2; or exactly `low * 2^exp`,
/// if both are equal.
#[derive(Clone, Debug)]
pub(super) struct Enclosure<T> {
    pub(super) low: T,
    pub(super) high: T,
    pub(super) exp: i32,
}

/// ln 2 in units of `2^-64`, truncated.
const LN2: u64 = 0xB172_17F7_D1CF_79AB;
/// Guard bits beyond the places requested.
const GUARD: u32 = 32;

fn high_half(a: u64, b: u64) -> u64 {
    ((u128::from(a) * u128::from(b)) >> 64) as u64
}

/// Encloses `2^(x - floor x)` for a non-integer `x = (-1)^sign * sig * 2^exp / den`, in units of `2^-62`; `exp` is 0
/// unless `den` is 1.
///
/// Truncation error: one unit of `2^-64` in `f`, two more in `t = f ln 2`, and at most two of `2^-62` in each Horner
/// step, which later steps shrink by `t/k`: below 8 units in all. The series' tail from `t^23/23!` on is below `2^-80`.
pub(super) fn exp2_quick(sign: bool, sig: u64, exp: i32, den: u32) -> Enclosure<i128> {
    let places = exp.unsigned_abs();
    let f = if places <= 64 {
        let (part, den) = (u128::from(sig) << (64 - places), u128::from(den));
        // Toward minus infinity.
        let part = if sign { part.div_ceil(den) } else { part / den } as u64;
        if sign { part.wrapping_neg() } else { part }
    } else {
        let part = sig.checked_shr(places - 64).unwrap_or(0);
        if sign { (part + 1).wrapping_neg() } else { part }
    };
    let t = high_half(f, LN2);
    let mut sum = 1u64 << 62;
    for k in (1..=22).rev() {
        sum = (1 << 62) + high_half(t, sum) / k;
    }
    Enclosure { low: i128::from(sum), high: i128::from(sum) + 16, exp: -62 }
}

/// Like [`exp2_quick`], but with arbitrary precision, in units of `2^-places`.
///
/// Truncation error in units of `2^-(places + 32)`: four in `t`, four per term of the series.
pub(super) fn exp2_long(sign: bool, sig: u64, exp: i32, den: u32, places: u32) -> Enclosure<BigInt> {
    let bits = places + GUARD;
    let signed = if sign { -BigInt::from(sig) } else { BigInt::from(sig) };
    // Arithmetic shifts and masks of a two's complement BigInt round toward minus infinity.
    let shift = i64::from(bits) + i64::from(exp);
    let x = if shift >= 0 { signed << shift } else { signed >> -shift };
    // A quotient rounds toward zero.
    let x = if sign { (x - (den - 1)) / den } else { x / den };
    let f = &x - ((&x >> bits) << bits);
    let t = (f * series::ln_2(bits.into())) >> bits;
    enclosed(series::exp(&t, bits.into()), places)
}

/// `cos x` or `sin x` for `x = (-1)^sign * sig * 2^exp / den`, in units of `2^-places`.
pub(super) fn circular(sine: bool, sign: bool, sig: u64, exp: i32, den: u32, places: u32) -> Enclosure<BigInt> {
    let bits = places + GUARD;
    let wide = bits + u32::try_from(exp + 64).unwrap_or(0);
    let signed = if sign { -BigInt::from(sig) } else { BigInt::from(sig) };
    let shift = i64::from(wide) + i64::from(exp);
    let shifted = if shift >= 0 { signed << shift } else { signed >> -shift };
    enclosed(series::circular(sine, &(shifted / den), wide.into(), bits.into()), places)
}

/// A sum in units of `2^-(places + 32)`. Its error is below `2^20` units, a small part of one unit of `2^-places`: a
/// series has fewer than `2^13` terms.
fn enclosed(sum: BigInt, places: u32) -> Enclosure<BigInt> {
    let low: BigInt = (sum >> GUARD) - 1;
    Enclosure { high: &low + 3, low, exp: -places.cast_signed() }
}

/// `log2` of `sig` scaled into [1, 2), in units of `2^-60`.
///
/// Squaring doubles a logarithm, so each squaring that passes 2 yields a binary digit. A relative error of `2^-62` in
/// the squaring that yields digit j is an error of `1.5 * 2^-62 * 2^-j` in the logarithm; together with the digits that
/// are not computed, the error is below 2 units.
pub(super) fn log2_quick(sig: u64) -> Enclosure<i128> {
    if sig.is_power_of_two() {
        return Enclosure { low: 0, high: 0, exp: -60 };
    }
    let mut y = sig << sig.leading_zeros();
    let mut digits = 0i128;
    for _ in 0..60 {
        let square = u128::from(y) * u128::from(y);
        let passed = square >> 127 == 1;
        y = if passed { (square >> 64) as u64 } else { (square >> 63) as u64 };
        digits = digits << 1 | i128::from(passed);
    }
    Enclosure { low: digits, high: digits + 4, exp: -60 }
}

/// Like [`log2_quick`], but with arbitrary precision, in units of `2^-places`.
pub(super) fn log2_long(sig: u64, places: u32) -> Enclosure<BigInt> {
    if sig.is_power_of_two() {
        return Enclosure { low: BigInt::ZERO, high: BigInt::ZERO, exp: -places.cast_signed() };
    }
    let bits = u64::from(places + GUARD);
    let top = u64::from(63 - sig.leading_zeros());
    let mut y = BigUint::from(sig) << (bits - top);
    let mut digits = BigInt::ZERO;
    for _ in 0..places {
        let square = &y * &y;
        let passed = square.bits() == 2 * bits + 2;
        y = square >> (bits + u64::from(passed));
        digits = (digits << 1) + u32::from(passed);
    }
    Enclosure { high: &digits + 4, low: digits, exp: -places.cast_signed() }
}
