//! Rounding: encodes an exact magnitude as bits and flags.

use num_bigint::BigUint;
use num_traits::{ToPrimitive, Zero};

use super::env::{Env, Tininess};
use super::flags::{Flags, Outcome};
use super::format::{Format, FormatKind};
use super::rules::{Denormals, Encoding, Overflow, Rounding};
use super::unpack::invalid;
pub(crate) use super::unpack::zero;

/// Exponents of larger magnitude overflow or underflow in every format; clamping to this keeps the arithmetic in range.
const FAR: i32 = 1 << 20;

/// Rounds `(-1)^sign * v` once into the format, where `v = sig * 2^exp`, or with `sticky` some `v` strictly between
/// `sig * 2^exp` and `(sig + 1) * 2^exp`. With `sticky` there must be no number of the format, and no midpoint of two,
/// strictly between these two, otherwise the result is undetermined. This holds if `2^exp` is at most half a unit in
/// the last place of the result.
pub fn from_parts(env: impl Into<Env>, sign: bool, sig: u128, exp: i32, sticky: bool) -> Outcome {
    let env = env.into();
    // A denominator has at most 8 bits: bits that it shifts out of the word are below every unit in the last place.
    let den = u128::from(env.format.denominator());
    match sig.checked_mul(den) {
        Some(sig) => in_units(&env, sign, sig, exp, sticky),
        None => {
            let low = (sig & 0xff) * den;
            in_units(&env, sign, (sig >> 8) * den + (low >> 8), exp + 8, sticky || low & 0xff != 0)
        }
    }
}

/// Rounds `(-1)^sign * sig * 2^exp / den` once into the format; `den` is not zero, and `sig` times the format's
/// denominator is below `2^64`. Only this function divides by a denominator.
#[inline]
pub(crate) fn round_quotient(env: &Env, sign: bool, sig: u64, exp: i32, den: u64) -> Outcome {
    let unit = u64::from(env.format.denominator());
    let (sig, den) = match den {
        _ if den == unit => (sig, 1),
        _ if den == unit * unit => (sig, unit),
        _ => (sig * unit, den),
    };
    if den == 1 || sig == 0 {
        return round(env, sign, sig, exp, false);
    }
    if let Rounding::Stochastic(_) = env.format.rounding {
        // Stochastic rounding needs more bits, for the 32 of the fraction.
        let left = u128::from(sig).leading_zeros();
        let (dividend, den) = (u128::from(sig) << left, u128::from(den));
        return in_units(env, sign, dividend / den, exp - left.cast_signed(), dividend % den != 0);
    }
    // With the dividend's leading bit at 2^63 a float's quotient has 40 bits or more; in fixed point its last bit is
    // 2^-32 or less, half a unit of the finest format.
    let left = sig.leading_zeros();
    let dividend = sig << left;
    round(env, sign, dividend / den, exp - left.cast_signed(), dividend % den != 0)
}

/// [`from_parts`] of `sig * 2^exp`, divided by the format's denominator.
pub(crate) fn in_units(env: &Env, sign: bool, sig: u128, exp: i32, sticky: bool) -> Outcome {
    if sig >> 64 == 0 {
        return round(env, sign, sig as u64, exp, sticky);
    }
    let exp = exp.clamp(-FAR, FAR);
    match env.format.kind {
        FormatKind::Fixed { int_bits, frac_bits } => {
            round_fixed(&env.format, int_bits + frac_bits, frac_bits, sign, sig, exp, sticky)
        }
        FormatKind::Normalized { int_bits, frac_bits } => {
            round_fixed(&env.format, int_bits + frac_bits, 0, sign, sig, exp, sticky)
        }
        FormatKind::Float { man_bits, .. } => {
            // Rounding needs only 64 leading bits and a sticky bit.
            let drop = 64 - sig.leading_zeros();
            let lost = sig & ((1 << drop) - 1) != 0;
            round_float(env, man_bits, sign, (sig >> drop) as u64, exp + drop.cast_signed(), sticky | lost)
        }
    }
}

/// [`in_units`] for magnitudes of 64 bits: the common case.
#[inline]
pub(crate) fn round(env: &Env, sign: bool, sig: u64, exp: i32, sticky: bool) -> Outcome {
    let exp = exp.clamp(-FAR, FAR);
    match env.format.kind {
        FormatKind::Fixed { int_bits, frac_bits } => {
            round_fixed(&env.format, int_bits + frac_bits, frac_bits, sign, u128::from(sig), exp, sticky)
        }
        FormatKind::Normalized { int_bits, frac_bits } => {
            round_fixed(&env.format, int_bits + frac_bits, 0, sign, u128::from(sig), exp, sticky)
        }
        FormatKind::Float { man_bits, .. } => round_float(env, man_bits, sign, sig, exp, sticky),
    }
}

/// Returns `true` if rounding increments the truncated magnitude.
///
/// `fraction` computes the first 32 bits of the discarded fraction.
#[inline]
fn goes_up(rounding: Rounding, sign: bool, odd: bool, half: bool, below: bool, fraction: impl Fn() -> u32) -> bool {
    match rounding {
        Rounding::NearestEven => half && (below || odd),
        Rounding::NearestAway => half,
        Rounding::TowardZero => false,
        Rounding::Down | Rounding::Up => rounding.is_outward(sign) && (half || below),
        Rounding::Odd => !odd && (half || below),
        Rounding::Stochastic(word) => fraction().checked_add(word).is_none(),
    }
}

/// The first 32 bits of the fraction of `sig / 2^shift`; `shift` is at least 1.
fn fraction(sig: u128, shift: i32) -> u32 {
    let shift = shift.unsigned_abs();
    if shift < 32 { (sig as u32) << (32 - shift) } else { sig.checked_shr(shift - 32).unwrap_or(0) as u32 }
}

/// Rounds `sig / 2^shift` to an integer; also returns `true` if the result is inexact.
#[inline]
fn shift_round(rounding: Rounding, sign: bool, sig: u64, shift: i32, sticky: bool) -> (u64, bool) {
    if shift <= 0 {
        return (sig << -shift, sticky);
    }
    if shift > 64 {
        let lost = sig != 0 || sticky;
        let up = goes_up(rounding, sign, false, false, lost, || fraction(sig.into(), shift));
        return (u64::from(up), lost);
    }
    let half = (sig >> (shift - 1)) & 1 == 1;
    let below = sticky || sig & ((1 << (shift - 1)) - 1) != 0;
    let kept = if shift == 64 { 0 } else { sig >> shift };
    let up = goes_up(rounding, sign, kept & 1 == 1, half, below, || fraction(sig.into(), shift));
    (kept + u64::from(up), half || below)
}

#[inline]
fn round_float(env: &Env, man_bits: u8, sign: bool, sig: u64, exp: i32, sticky: bool) -> Outcome {
    let format = &env.format;
    if sig == 0 && !sticky {
        return zero(format, sign);
    }
    let man = i32::from(man_bits);
    let (min_exp, max_exp) = format.exponents();
    // With the leading bit at 2^63, the last place of every float is above the last bit of `sig`. (Zero with a sticky
    // bit keeps its exponent.)
    let left = sig.leading_zeros() & 63;
    let (sig, exp) = (sig << left, exp - left.cast_signed());
    // The value lies in [2^top, 2^(top+1)); its unit in the last place is 2^unit.
    let top = if sig == 0 { exp - 1 } else { exp + 63 };
    if format.encoding == Encoding::Scale {
        return round_scale(format, sign, sig, top, sticky);
    }
    let unit = (top - man).max(min_exp - man);
    let (kept, inexact) = shift_round(format.rounding, sign, sig, unit - exp, sticky);
    // Adds exponent field and mantissa: the hidden bit increments the exponent, and so does a carry.
    let magnitude = (((unit - min_exp + man) as u64) << man) + kept;
    if magnitude > u64::from(format.max_finite()) {
        return overflow_float(format, sign, top > max_exp);
    }
    let mut flags = if inexact { Flags::INEXACT } else { Flags::empty() };
    if inexact && top < min_exp {
        // Tininess after rounding: with an unbounded exponent, the value would round up to the smallest normal number.
        let grows = env.tininess == Tininess::After
            && top == min_exp - 1
            && shift_round(format.rounding, sign, sig, top - man - exp, sticky).0 >> (man + 1) != 0;
        if !grows {
            flags |= Flags::UNDERFLOW;
        }
    }
    if format.denormals == Denormals::Flush && magnitude != 0 && magnitude >> man == 0 {
        return zero(format, sign).also(Flags::UNDERFLOW | Flags::INEXACT);
    }
    if magnitude == 0 {
        return zero(format, sign).also(flags);
    }
    Outcome::new(magnitude as u32 | if sign { format.sign_bit() } else { 0 }, flags)
}

/// Rounds `2^top` times a number in [1, 2) to a scale: `sig` is the number with its leading bit at 2^63, or 0 for an
/// unknown value above zero. Ties go up: a one-digit significand is never even (IEEE 754-2019, 4.3.1). Positive values
/// below the smallest scale become the smallest scale.
fn round_scale(format: &Format, sign: bool, sig: u64, top: i32, sticky: bool) -> Outcome {
    let (least, most) = format.exponents();
    if sign {
        return invalid(format);
    }
    let (kept, inexact) = shift_round(format.rounding, sign, sig, 63, sticky);
    let exponent = top + i32::from(kept == 2);
    if exponent > most {
        return overflow_float(format, sign, top > most);
    }
    if sig == 0 || exponent < least {
        return Outcome::new(format.min_finite(), Flags::UNDERFLOW | Flags::INEXACT);
    }
    Outcome::new((exponent - least).unsigned_abs(), if inexact { Flags::INEXACT } else { Flags::empty() })
}

/// The result of a float overflow; `huge` is `true` if the exact magnitude is `2^(emax+1)` or more.
fn overflow_float(format: &Format, sign: bool, huge: bool) -> Outcome {
    let infinite = match format.overflow {
        Overflow::Saturate => false,
        Overflow::Nv30 => huge,
        Overflow::Infinity | Overflow::Wrap => match format.rounding {
            Rounding::NearestEven | Rounding::NearestAway => true,
            Rounding::TowardZero | Rounding::Odd => false,
            Rounding::Stochastic(_) => true,
            Rounding::Down | Rounding::Up => format.rounding.is_outward(sign),
        },
    };
    let bits = if infinite { unbounded(format, sign) } else { format.extreme(sign) };
    Outcome::new(bits, Flags::OVERFLOW | Flags::INEXACT)
}

#[inline]
fn round_fixed(
    format: &Format,
    magnitude_bits: u8,
    frac_bits: u8,
    sign: bool,
    sig: u128,
    exp: i32,
    sticky: bool,
) -> Outcome {
    let shift = -(exp + i32::from(frac_bits));
    let (kept, carry_out, inexact) = if shift <= 0 {
        let left = shift.unsigned_abs();
        let kept = if left >= 128 { 0 } else { sig << left };
        (kept, sig != 0 && sig.leading_zeros() < left, sticky)
    } else if sig >> 64 == 0 {
        let (kept, inexact) = shift_round(format.rounding, sign, sig as u64, shift, sticky);
        (u128::from(kept), false, inexact)
    } else if shift > 128 {
        let up = goes_up(format.rounding, sign, false, false, true, || fraction(sig, shift));
        (u128::from(up), false, true)
    } else {
        let half = (sig >> (shift - 1)) & 1 == 1;
        let below = sticky || sig & ((1 << (shift - 1)) - 1) != 0;
        let kept = if shift == 128 { 0 } else { sig >> shift };
        let up = goes_up(format.rounding, sign, kept & 1 == 1, half, below, || fraction(sig, shift));
        (kept + u128::from(up), false, half || below)
    };
    // Two's complement has one more unit on the negative side.
    let limit = (1u128 << magnitude_bits) - u128::from(!sign);
    let low = kept as u32;
    let bits = (if sign { low.wrapping_neg() } else { low }) & format.mask();
    if kept > limit || carry_out {
        let bits = if format.overflow == Overflow::Wrap { bits } else { format.extreme(sign) };
        return Outcome::new(bits, Flags::OVERFLOW | Flags::INEXACT);
    }
    Outcome::new(bits, if inexact { Flags::INEXACT } else { Flags::empty() })
}

/// The pattern for an infinite result: infinity if the format has it, else NaN, else the end of the range.
fn unbounded(format: &Format, sign: bool) -> u32 {
    format.infinity(sign).or(format.canonical_nan()).unwrap_or(format.extreme(sign))
}

/// The result of an exact infinity from finite operands: infinity ([`unbounded`]), or the end of the range if the
/// format saturates.
pub(crate) fn divide_by_zero(format: &Format, sign: bool) -> Outcome {
    let saturates = format.overflow == Overflow::Saturate;
    Outcome::new(if saturates { format.extreme(sign) } else { unbounded(format, sign) }, Flags::DIVIDE_BY_ZERO)
}

/// The result of an infinite operand: infinity. Formats without infinity raise `OVERFLOW` and give [`unbounded`], or
/// the end of the range if they saturate.
pub(crate) fn infinite(format: &Format, sign: bool) -> Outcome {
    match format.infinity(sign) {
        Some(bits) => Outcome::exact(bits),
        None => Outcome::new(divide_by_zero(format, sign).bits, Flags::OVERFLOW | Flags::INEXACT),
    }
}

/// Computes the quotient `num / den`, rounded once. Used for texel decoding and attribute interpolation.
///
/// `den = 0` is a division by zero (`0/0`: `INVALID`). In a wrapping format the quotient must be below `2^64`.
pub fn from_ratio(env: impl Into<Env>, negative: bool, num: u128, den: u128) -> Outcome {
    let env = env.into();
    match (num, den) {
        (0, 0) => return invalid(&env.format),
        (_, 0) => return divide_by_zero(&env.format, negative),
        (0, _) => return zero(&env.format, negative),
        _ => {}
    }
    if num >> 32 == 0 && den >> 32 == 0 {
        return round_quotient(&env, negative, num as u64, 0, den as u64);
    }
    let Some(num) = num.checked_mul(env.format.denominator().into()) else {
        return round_big(&env, negative, &num.into(), &den.into());
    };
    let shift = num.leading_zeros();
    let scaled = num << shift;
    let (mut quotient, mut rest) = (scaled / den, scaled % den);
    let mut exp = -shift.cast_signed();
    // Long division, bit by bit, until the quotient is long enough for rounding.
    while rest != 0 && quotient >> 126 == 0 && (quotient >> 64 == 0 || exp > -33) {
        let bit = rest >= den - rest;
        rest = if bit { rest - (den - rest) } else { rest << 1 };
        quotient = quotient << 1 | u128::from(bit);
        exp -= 1;
    }
    in_units(&env, negative, quotient, exp, rest != 0)
}

/// `num / den`, neither of them zero, rounded once.
pub(crate) fn round_big(env: &Env, negative: bool, num: &BigUint, den: &BigUint) -> Outcome {
    let num = num * env.format.denominator();
    // Computes at least 66 bits of the quotient, and at least all bits down to 2^-40.
    let left = (den.bits() + 66).saturating_sub(num.bits()).max(40);
    let scaled = num << left;
    let quotient = &scaled / den;
    let drop = quotient.bits().saturating_sub(126);
    let sticky = quotient.trailing_zeros().unwrap_or(0) < drop || !(&scaled % den).is_zero();
    let kept = (quotient >> drop).to_u128().unwrap_or(0);
    in_units(env, negative, kept, (drop.cast_signed() - left.cast_signed()) as i32, sticky)
}
