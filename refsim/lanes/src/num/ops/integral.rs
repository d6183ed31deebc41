//! Floor, fraction and rounding to integers.

use crate::num::env::Env;
use crate::num::flags::{Flags, Outcome};
use crate::num::round::{from_parts, infinite};
use crate::num::rules::Rounding;
use crate::num::sum::{Term, sum};
use crate::num::unit;
use crate::num::unit::UnitOperation;
use crate::num::unpack::{Unpacked, invalid, nan_result, unpack};

/// The largest integer not above `x`. Never `INEXACT`; infinities and zeros keep their sign.
pub fn floor(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Floor, &[x]) {
        return done;
    }
    round_to_int_with(env, x, Rounding::Down, false)
}

/// `x` rounded to an integer by the format's rounding, without `INEXACT` (TestFloat's `roundToInt`).
pub fn round_to_int(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    round_to_int_with(env, x, env.format.rounding, false)
}

/// [`round_to_int`], but raises `INEXACT` if it changes the value (TestFloat's `-exact`).
pub fn round_to_int_exact(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    round_to_int_with(env, x, env.format.rounding, true)
}

/// `x` rounded to an integer by the given rounding; with `exact`, a change of the value raises `INEXACT`.
///
/// A zero result keeps the operand's sign. The integer may lie outside a short format's range (8 in `s3.12`); then the
/// format's overflow rule applies.
pub fn round_to_int_with(env: impl Into<Env>, x: u32, rounding: Rounding, exact: bool) -> Outcome {
    let env = env.into();
    let value = unpack(&env.format, x);
    let (sign, sig, exp, den) = match value {
        Unpacked::Nan { .. } => return nan_result(&env.format, &[value]),
        Unpacked::Inf { sign } => return infinite(&env.format, sign),
        Unpacked::Finite { sign, sig, exp, den } => (sign, sig, exp, den),
    };
    if exp >= 0 && den == 1 {
        return from_parts(env, sign, sig.into(), exp, false);
    }
    let (integer, rest, one) = split(sig, exp, den);
    let up = match rounding {
        Rounding::NearestEven => 2 * rest > one || (2 * rest == one && integer % 2 == 1),
        Rounding::NearestAway => 2 * rest >= one,
        Rounding::TowardZero => false,
        Rounding::Down | Rounding::Up => rounding.is_outward(sign) && rest != 0,
        Rounding::Odd => integer % 2 == 0 && rest != 0,
        Rounding::Stochastic(word) => ((u128::from(rest) << 32) / u128::from(one) + u128::from(word)) >> 32 != 0,
    };
    let outcome = from_parts(env, sign, u128::from(integer + u64::from(up)), 0, false);
    outcome.also(if exact && rest != 0 { Flags::INEXACT } else { Flags::empty() })
}

/// Splits `sig * 2^exp / den`, with `exp` at most 0, into integer part, remainder, and the remainder that corresponds
/// to 1.
fn split(sig: u64, exp: i32, den: u32) -> (u64, u64, u64) {
    // `sig` has at most 32 bits, so after dropping 40 bits the remainder still compares correctly with one half.
    let one = u64::from(den) << exp.unsigned_abs().min(40);
    (sig / one, sig % one, one)
}

/// `x - floor(x)`, rounded once. A small negative `x` may round to 1. Integers give +0 (-0 when rounding down);
/// infinities raise `INVALID`.
pub fn frc(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Frc, &[x]) {
        return done;
    }
    let value = unpack(&env.format, x);
    let (sign, sig, exp, den) = match value {
        Unpacked::Nan { .. } => return nan_result(&env.format, &[value]),
        Unpacked::Inf { .. } => return invalid(&env.format),
        Unpacked::Finite { sign, sig, exp, den } => (sign, sig, exp, den),
    };
    let rest = if exp > 0 { 0 } else { split(sig, exp, den).1 };
    // x - floor(x) is the remainder for positive x, and one minus the remainder for negative x.
    let fraction = Term { sign, sig: rest, exp };
    let whole = Term { sign: !sign, sig: u64::from(sign && rest != 0) * u64::from(den), exp: 0 };
    if rest == 0 {
        return sum(&env, Term { sign: false, sig: 0, exp }, Term { sign: true, sig: 0, exp });
    }
    sum(&env, fraction, whole)
}
