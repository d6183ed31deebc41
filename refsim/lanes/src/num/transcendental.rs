//! Correctly rounded transcendental functions: base-two exponential and logarithm, power, sine and cosine.
//!
//! An irrational value is enclosed between two integers in units of `2^-places`. If both ends round to the same bits
//! and flags, so does the value between them (rounding is monotone); if not, the enclosure is recomputed with twice the
//! places (Ziv's strategy). The enclosure times the format's denominator is rounded, because rounding counts in units
//! of the format. Exact results are handled separately, so the loop ends: `2^x` is irrational for every rational `x`
//! that isn't an integer, and `log2 x` for every rational `x` that isn't a power of two.

mod enclose;

use num_bigint::BigInt;
use num_traits::ToPrimitive;

use self::enclose::Enclosure;
use super::env::Env;
use super::flags::{Flags, Outcome};
use super::format::FormatKind;
use super::ops::mul;
use super::round::{divide_by_zero, from_parts, in_units, infinite, zero};
use super::rules::Overflow;
use super::series;
use super::unit;
use super::unit::UnitOperation;
use super::unpack::{Unpacked, invalid, nan_result, unpack};

/// Precisions, in places, that are tried after the quick enclosure. Operands have at most 150 fraction bits and results
/// at most 24 bits, so the higher precisions are never reached in practice.
const PLACES: [u32; 6] = [128, 256, 512, 1024, 2048, 4096];

/// `2^x`, correctly rounded. `2^-inf` is +0. In a wrapping format an overflowing result saturates.
pub fn exp2(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Exp2, &[x]) {
        return done;
    }
    let format = &env.format;
    let value = unpack(format, x);
    let (sign, sig, exp, den) = match value {
        Unpacked::Nan { .. } => return nan_result(format, &[value]),
        Unpacked::Inf { sign: false } => return infinite(format, false),
        Unpacked::Inf { sign: true } => return zero(format, false),
        Unpacked::Finite { sign, sig, exp, den } => (sign, sig, exp, den),
    };
    let whole = floor_clamped(sign, sig, exp, den);
    // An overflowing exponential has no residue to wrap to, so it saturates.
    if let FormatKind::Fixed { int_bits, .. } | FormatKind::Normalized { int_bits, .. } = format.kind
        && format.overflow == Overflow::Wrap
        && whole >= i32::from(int_bits)
    {
        return Outcome::new(format.max_finite(), Flags::OVERFLOW | Flags::INEXACT);
    }
    // An integer exponent: the result is an exact power of two.
    let integral = exp >= 0 || sig == 0 || sig.trailing_zeros() >= exp.unsigned_abs();
    if integral && sig.is_multiple_of(den.into()) {
        return from_parts(env, false, 1, whole, false);
    }
    let quick = enclose::exp2_quick(sign, sig, exp, den);
    decide_quick(&env, quick.low, quick.high, quick.exp + whole).unwrap_or_else(|| {
        decide_long(&env, |places| {
            let long = enclose::exp2_long(sign, sig, exp, den, places);
            Enclosure { exp: long.exp + whole, ..long }
        })
    })
}

/// `floor(x)`, clamped to +-2^20, where every format overflows or underflows.
fn floor_clamped(sign: bool, sig: u64, exp: i32, den: u32) -> i32 {
    const FAR: i64 = 1 << 20;
    let value = if sign { -i128::from(sig) } else { i128::from(sig) }.div_euclid(den.into());
    let floor = if exp >= 0 { value << exp.min(60) } else { value >> exp.unsigned_abs().min(100) };
    i32::try_from(floor.clamp(-i128::from(FAR), i128::from(FAR))).unwrap_or(0)
}

/// `log2 x`, correctly rounded.
///
/// Zero gives -inf with `DIVIDE_BY_ZERO` (the most negative number in fixed point and `:sat` floats). A negative
/// operand is `INVALID` (IEEE 754, 9.2.1).
pub fn log2(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Log2, &[x]) {
        return done;
    }
    let format = &env.format;
    let value = unpack(format, x);
    match value {
        Unpacked::Nan { .. } => nan_result(format, &[value]),
        Unpacked::Finite { sig: 0, .. } => divide_by_zero(format, true),
        Unpacked::Inf { sign: true } | Unpacked::Finite { sign: true, .. } => invalid(format),
        Unpacked::Inf { .. } => infinite(format, false),
        Unpacked::Finite { sig, exp, den, .. } => {
            let den = u64::from(den);
            // The logarithm of a power of two is an exact integer.
            if sig.is_multiple_of(den) && (sig / den).is_power_of_two() {
                let whole = exp + (sig / den).ilog2().cast_signed();
                return from_parts(env, whole < 0, whole.unsigned_abs().into(), 0, false);
            }
            // The difference of two logarithms; the logarithm of 1 is 0.
            let whole = exp + sig.ilog2().cast_signed() - den.ilog2().cast_signed();
            let [quick, less] = [enclose::log2_quick(sig), enclose::log2_quick(den)];
            let base = i128::from(whole) << quick.exp.unsigned_abs();
            decide_quick(&env, base + quick.low - less.high, base + quick.high - less.low, quick.exp).unwrap_or_else(
                || {
                    decide_long(&env, |places| {
                        let [long, less] = [enclose::log2_long(sig, places), enclose::log2_long(den, places)];
                        let base = BigInt::from(whole) << places;
                        Enclosure {
                            low: &base + long.low - less.high,
                            high: base + long.high - less.low,
                            exp: long.exp,
                        }
                    })
                },
            )
        }
    }
}

/// `cos x`, x in radians, correctly rounded. An infinite angle is `INVALID`.
pub fn cos(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Cos, &[x]) {
        return done;
    }
    circular(env, x, false)
}

/// `sin x`, x in radians, correctly rounded; a zero keeps its sign. An infinite angle is `INVALID`.
pub fn sin(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Sin, &[x]) {
        return done;
    }
    circular(env, x, true)
}

/// Sine or cosine. They are irrational at every rational angle but 0, so every enclosure is decided eventually.
fn circular(env: Env, x: u32, sine: bool) -> Outcome {
    let format = &env.format;
    let value = unpack(format, x);
    match value {
        Unpacked::Nan { .. } => nan_result(format, &[value]),
        Unpacked::Inf { .. } => invalid(format),
        Unpacked::Finite { sign, sig: 0, .. } if sine => zero(format, sign),
        Unpacked::Finite { sig: 0, .. } => from_parts(env, false, 1, 0, false),
        Unpacked::Finite { sign, sig, exp, den } => {
            decide_long(&env, |places| enclose::circular(sine, sign, sig, exp, den, places))
        }
    }
}

/// `x^y` as `exp2(y * log2 x)`, each of the three steps rounded once in the format. So `pow(0, 0)` is NaN (0 times
/// -inf), and a negative `x` is `INVALID`, as in `NV_fragment_program`. Direct3D's `pow` takes the magnitude of `x`.
pub fn pow(env: impl Into<Env>, x: u32, y: u32) -> Outcome {
    let env = env.into();
    let log = log2(env, x);
    let product = mul(env, y, log.bits);
    exp2(env, product.bits).also(log.flags | product.flags)
}

/// Returns the rounded result that all values strictly between `low * 2^exp` and `high * 2^exp` share; `None` if their
/// results differ in bits or flags.
fn decide_quick(env: &Env, low: i128, high: i128, exp: i32) -> Option<Outcome> {
    let (sign, near, far) = match (low >= 0, high <= 0) {
        (true, _) => (false, low, high),
        (_, true) => (true, -high, -low),
        _ => return None,
    };
    let den = u128::from(env.format.denominator());
    // The value's floor is in near ..= far - 1.
    let first = in_units(env, sign, near.unsigned_abs() * den, exp, true);
    let last = in_units(env, sign, far.unsigned_abs() * den - 1, exp, true);
    (first == last).then_some(first)
}

/// Rounds by enclosures of increasing precision.
fn decide_long(env: &Env, enclosure: impl Fn(u32) -> Enclosure<BigInt>) -> Outcome {
    let mut best = Outcome::exact(0);
    for places in PLACES {
        let Enclosure { low, high, exp } = enclosure(places);
        let den = env.format.denominator();
        let (low, high) = (low * den, high * den);
        let (sign, near, far) = match (low >= BigInt::ZERO, high <= BigInt::ZERO) {
            (true, _) => (false, low, high),
            (_, true) => (true, -high, -low),
            _ => continue,
        };
        best = round_big(env, sign, &near, exp);
        if best == round_big(env, sign, &(far - 1), exp) {
            break;
        }
    }
    best
}

/// Rounds a value strictly between `floor * 2^exp` and `(floor + 1) * 2^exp`, in units of the format.
fn round_big(env: &Env, sign: bool, floor: &BigInt, exp: i32) -> Outcome {
    let magnitude = floor.magnitude();
    let drop = magnitude.bits().saturating_sub(120);
    let kept = (magnitude >> drop).to_u128().unwrap_or(0);
    in_units(env, sign, kept, exp + i32::try_from(drop).unwrap_or(0), true)
}
