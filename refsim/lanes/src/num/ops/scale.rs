//! Modifiers: sign changes, powers of two, saturation.

use crate::num::env::Env;
use crate::num::flags::Outcome;
use crate::num::round::{round, zero};
use crate::num::rules::Specials;
use crate::num::unit;
use crate::num::unit::UnitOperation;
use crate::num::unpack::{Unpacked, invalid, key, nan_bits, nan_result, pass, unpack};

/// `-x`. In fixed point the most negative number overflows. A NaN becomes the canonical one and raises nothing.
pub fn neg(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Neg, &[x]) {
        return done;
    }
    with_sign(&env, x, |sign| !sign)
}

/// `|x|`. In fixed point the most negative number overflows. A NaN becomes the canonical one and raises nothing.
pub fn abs(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Abs, &[x]) {
        return done;
    }
    with_sign(&env, x, |_| false)
}

fn with_sign(env: &Env, x: u32, change: impl Fn(bool) -> bool) -> Outcome {
    let format = &env.format;
    match unpack(format, x) {
        Unpacked::Finite { sign, sig, exp, .. } if format.is_fixed() => round(env, change(sign), sig, exp, false),
        Unpacked::Nan { .. } => Outcome::exact(nan_bits(format)),
        Unpacked::Finite { sign, sig: 0, .. } => zero(format, change(sign)),
        Unpacked::Finite { sign, .. } if change(sign) && !format.is_signed() => invalid(format),
        Unpacked::Inf { sign } | Unpacked::Finite { sign, .. } => {
            let magnitude = pass(format, x) & !format.sign_bit();
            Outcome::exact(if change(sign) { magnitude | format.sign_bit() } else { magnitude })
        }
    }
}

/// `x * 2^k`, rounded once: the shift modifiers `_x2 _x4 _x8 _d2 _d4 _d8`.
pub fn scale(env: impl Into<Env>, x: u32, k: i32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Scale, &[x, k.cast_unsigned()]) {
        return done;
    }
    let value = unpack(&env.format, x);
    match value {
        Unpacked::Nan { .. } => nan_result(&env.format, &[value]),
        Unpacked::Inf { .. } => Outcome::exact(pass(&env.format, x)),
        Unpacked::Finite { sign, sig, exp, .. } => round(&env, sign, sig, exp.saturating_add(k), false),
    }
}

/// The `_sat` modifier: `x` clamped to [0, 1], with +0 for everything that isn't positive. NaN gives +0, or NaN with
/// [`Specials::Nv`]. Raises nothing.
pub fn saturate01(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Saturate, &[x]) {
        return done;
    }
    let format = env.format;
    if format.is_nan(x) {
        return Outcome::exact(if format.specials == Specials::Nv { nan_bits(&format) } else { 0 });
    }
    let one = format.one();
    let value = key(&format, x);
    Outcome::exact(if value <= 0 {
        0
    } else if value >= i64::from(one) {
        one
    } else {
        pass(&format, x)
    })
}
