//! Sums of two signed magnitudes, exact up to a sticky bit.

use super::env::Env;
use super::flags::Outcome;
use super::round::{in_units, round_quotient, zero};
use super::rules::Rounding;

/// `(-1)^sign * sig * 2^exp` over a denominator that all terms of a sum share, exact; `sig` is below `2^64`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Term {
    pub(crate) sign: bool,
    pub(crate) sig: u64,
    pub(crate) exp: i32,
}

/// Sign of an exact zero sum, unless all terms are zeros with the same sign (IEEE 754-2019, 6.3).
pub(crate) fn cancelled(env: &Env) -> bool {
    env.format.rounding == Rounding::Down
}

/// `a + b` in units of the format, rounded once.
pub(crate) fn sum(env: &Env, a: Term, b: Term) -> Outcome {
    sum_over(env, a, b, env.format.denominator().into())
}

/// `(a + b) / den`, rounded once; `den` is 1 if terms have exponents; otherwise the sum fits in one word.
pub(crate) fn sum_over(env: &Env, a: Term, b: Term, den: u64) -> Outcome {
    if a.sig == 0 && b.sig == 0 {
        let sign = if a.sign == b.sign { a.sign } else { cancelled(env) };
        return zero(&env.format, sign);
    }
    if b.sig == 0 {
        return round_quotient(env, a.sign, a.sig, a.exp, den);
    }
    if a.sig == 0 {
        return round_quotient(env, b.sign, b.sig, b.exp, den);
    }
    let (high, low) = if a.exp >= b.exp { (a, b) } else { (b, a) };
    let distance = high.exp.abs_diff(low.exp);
    if distance <= 30 && high.sig >> 32 == 0 && low.sig >> 62 == 0 {
        // The exact sum fits in one word.
        let signed = |negative: bool, sig: u64| if negative { -sig.cast_signed() } else { sig.cast_signed() };
        let total = signed(high.sign, high.sig << distance) + signed(low.sign, low.sig);
        let sign = if total == 0 { cancelled(env) } else { total < 0 };
        return round_quotient(env, sign, total.unsigned_abs(), low.exp, den);
    }
    // Left shift of the higher term (two bits stay free for the carry) and right shift of the lower one.
    let left = distance.min(u128::from(high.sig).leading_zeros() - 2);
    let right = distance - left;
    let high_sig = u128::from(high.sig) << left;
    let (low_sig, sticky) =
        if right >= 64 { (0, true) } else { (low.sig >> right, low.sig << (64 - right).min(63) != 0) };
    let sticky = right != 0 && sticky;
    let low_sig = u128::from(low_sig);
    let exp = high.exp - left.cast_signed();
    if high.sign == low.sign {
        return in_units(env, high.sign, high_sig + low_sig, exp, sticky);
    }
    if high_sig == low_sig && !sticky {
        return zero(&env.format, cancelled(env));
    }
    if high_sig >= low_sig {
        // The dropped bits make the difference smaller by less than one unit.
        in_units(env, high.sign, high_sig - low_sig - u128::from(sticky), exp, sticky)
    } else {
        in_units(env, low.sign, low_sig - high_sig, exp, false)
    }
}
