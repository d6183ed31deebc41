//! Square root and its reciprocal.

use crate::num::env::Env;
use crate::num::flags::Outcome;
use crate::num::round::{divide_by_zero, in_units, infinite, zero};
use crate::num::unit;
use crate::num::unit::UnitOperation;
use crate::num::unpack::{Unpacked, invalid, nan_result, unpack};

/// The square root. Negative operands are `INVALID` (fixed point: 0); `sqrt(-0)` is -0.
pub fn sqrt(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    let value = unpack(&env.format, x);
    match value {
        Unpacked::Nan { .. } => nan_result(&env.format, &[value]),
        Unpacked::Finite { sign, sig: 0, .. } => zero(&env.format, sign),
        Unpacked::Inf { sign: true } | Unpacked::Finite { sign: true, .. } => invalid(&env.format),
        Unpacked::Inf { sign: false } => infinite(&env.format, false),
        Unpacked::Finite { sig, exp, den, .. } => {
            // In units of 1/d, the root of s/d is the root of s d.
            let (square, exp) = even(sig * u64::from(den), exp);
            let root = square.isqrt();
            in_units(&env, false, root, exp / 2, root * root != square)
        }
    }
}

/// `1 / sqrt(x)`, rounded once.
///
/// Special values are those of `rSqrt` in IEEE 754 (9.2.1) and of `RSQ` in NV_fragment_program: `rsq(-0)` is -inf with
/// `DIVIDE_BY_ZERO`, and negative operands are `INVALID`. In fixed point zero gives the largest number and negative
/// operands are `INVALID`, result 0.
pub fn rsq(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Rsq, &[x]) {
        return done;
    }
    let format = &env.format;
    let value = unpack(format, x);
    match value {
        Unpacked::Nan { .. } => nan_result(format, &[value]),
        Unpacked::Finite { sign, sig: 0, .. } => divide_by_zero(format, sign),
        Unpacked::Inf { sign: true } | Unpacked::Finite { sign: true, .. } => invalid(format),
        Unpacked::Inf { .. } => zero(format, false),
        Unpacked::Finite { sig, exp, den, .. } => {
            // In units of 1/d, 1/sqrt(s/d * 2^e) = sqrt(d^3 2^p / s) * 2^(-e/2 - p/2) with s in [2^31, 2^33), p even
            // and d^3 2^p of about 126 bits. The floor of the root of a floor is the floor of the root; the root is
            // exact only if both steps are exact.
            let left =
                sig.leading_zeros() - 32 + (exp - sig.leading_zeros().cast_signed()).rem_euclid(2).unsigned_abs();
            let (s, e) = (u128::from(sig) << left, exp - left.cast_signed());
            let cube = u128::from(den).pow(3);
            let places = (126 - cube.ilog2()) & !1;
            let root = ((cube << places) / s).isqrt();
            let exact = root * root * s == cube << places;
            in_units(&env, false, root, -e / 2 - (places / 2).cast_signed(), !exact)
        }
    }
}

/// `sig * 2^exp` with an even exponent and 126 to 127 significant bits, so that the root has 63 or more.
fn even(sig: u64, exp: i32) -> (u128, i32) {
    let mut left = u128::from(sig).leading_zeros() - 1;
    if (exp - left.cast_signed()) % 2 != 0 {
        left -= 1;
    }
    (u128::from(sig) << left, exp - left.cast_signed())
}
