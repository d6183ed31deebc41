//! Conversion between formats.

use super::env::Env;
use super::flags::{Flags, Outcome};
use super::format::Format;
use super::round::{infinite, round_quotient};
use super::rules::{Denormals, Unit};
use super::unpack::{Unpacked, nan_bits, unpack, zero};

/// Converts the number `bits` from format `from` to format `to`, rounding once by `to`'s rules.
///
/// NaN stays NaN, with `INVALID` if it was signalling; in a format without NaN it becomes 0 with `INVALID`. Infinity
/// stays infinity; in fixed point it saturates with `OVERFLOW`, even in formats where finite numbers wrap; in floats
/// without infinity it overflows as finite numbers do.
///
/// Single floats are converted to the format of a card's unit unchanged. In the other direction, subnormals become
/// zeros, and a NaN of GT200 becomes the canonical NaN of the other format.
pub fn convert(from: &Format, to: impl Into<Env>, bits: u32) -> Outcome {
    let to = to.into();
    // Including NaN and subnormals.
    if to.format.takes_patterns_of(from) {
        return Outcome::exact(bits);
    }
    // GT200 flushes magnitudes below 2^-33 to zero half floats in every rounding.
    if matches!(from.unit, Unit::Gt200 | Unit::Gt200ZeroWins)
        && to.format.kind == Format::FP16.kind
        && bits << 1 < (127 - 33) << 24
    {
        return zero(&to.format, from.is_negative(bits));
    }
    rounded(&to, unpack(from, bits))
}

#[inline]
fn rounded(to: &Env, value: Unpacked) -> Outcome {
    match value {
        Unpacked::Nan { signaling } => {
            let bad = signaling || to.format.canonical_nan().is_none();
            Outcome::new(nan_bits(&to.format), if bad { Flags::INVALID } else { Flags::empty() })
        }
        Unpacked::Inf { sign } => infinite(&to.format, sign),
        Unpacked::Finite { sign, sig, exp, den } => round_quotient(to, sign, sig, exp, den.into()),
    }
}

/// Rounds a host double once into a format, by its rules; NaN and infinities as in [`convert`].
pub fn from_f64(to: impl Into<Env>, x: f64) -> Outcome {
    rounded(&to.into(), unpack_f64(x))
}

/// The value of a double; every NaN is quiet.
pub(super) fn unpack_f64(x: f64) -> Unpacked {
    let (sign, field, fraction) = (x.is_sign_negative(), (x.to_bits() >> 52 & 0x7ff) as i32, x.to_bits() & FRACTION);
    let sig = if field == 0 { fraction } else { fraction | (FRACTION + 1) };
    match field {
        0x7ff if fraction == 0 => Unpacked::Inf { sign },
        0x7ff => Unpacked::Nan { signaling: false },
        _ => Unpacked::Finite { sign, sig, exp: field.max(1) - 1075, den: 1 },
    }
}

/// The stored significand of a double.
const FRACTION: u64 = (1 << 52) - 1;

/// Converts a number to a host double, for display. Exact, because no format has more than 32 significant bits, except
/// for normalized formats, whose numbers are rounded to nearest; NaN and infinities are preserved.
pub fn to_f64(format: &Format, bits: u32) -> f64 {
    // Subnormals keep their value even in flushing formats: the stored number is shown, not the operand.
    match unpack(&format.with_denormals(Denormals::Keep), bits) {
        Unpacked::Nan { .. } => f64::NAN,
        Unpacked::Inf { sign: true } => f64::NEG_INFINITY,
        Unpacked::Inf { sign: false } => f64::INFINITY,
        Unpacked::Finite { sign, sig, exp, den } => {
            let magnitude = sig as f64 * power_of_two(exp) / f64::from(den);
            if sign { -magnitude } else { magnitude }
        }
    }
}

/// Returns 2^`exponent` as a host double, for host code; the exponent is clamped to the range of normal doubles.
pub const fn power_of_two(exponent: i32) -> f64 {
    let field = exponent + 1023;
    let field = if field < 1 {
        1
    } else if field > 2046 {
        2046
    } else {
        field
    };
    f64::from_bits((field.unsigned_abs() as u64) << 52)
}
