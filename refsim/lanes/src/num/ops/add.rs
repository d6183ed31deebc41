//! Addition and subtraction.

use crate::num::env::Env;
use crate::num::flags::Outcome;
use crate::num::round::infinite;
use crate::num::sum::{Term, sum};
use crate::num::unit;
use crate::num::unit::UnitOperation;
use crate::num::unpack::{Unpacked, invalid, nan_result, unpack};

/// `a + b`. `inf - inf` is `INVALID`; an exact zero is +0, or -0 when rounding down or when both operands are -0.
pub fn add(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Add, &[a, b]) {
        return done;
    }
    add_values(&env, unpack(&env.format, a), unpack(&env.format, b))
}

/// `a - b`, which is `a + (-b)`.
pub fn sub(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Sub, &[a, b]) {
        return done;
    }
    let negated = match unpack(&env.format, b) {
        Unpacked::Finite { sign, sig, exp, den } => Unpacked::Finite { sign: !sign, sig, exp, den },
        Unpacked::Inf { sign } => Unpacked::Inf { sign: !sign },
        nan => nan,
    };
    add_values(&env, unpack(&env.format, a), negated)
}

fn add_values(env: &Env, a: Unpacked, b: Unpacked) -> Outcome {
    use Unpacked::{Finite, Inf, Nan};
    match (a, b) {
        (Finite { sign: sa, sig: ma, exp: ea, .. }, Finite { sign: sb, sig: mb, exp: eb, .. }) => {
            sum(env, Term { sign: sa, sig: ma, exp: ea }, Term { sign: sb, sig: mb, exp: eb })
        }
        (Nan { .. }, _) | (_, Nan { .. }) => nan_result(&env.format, &[a, b]),
        (Inf { sign: sa }, Inf { sign: sb }) if sa != sb => invalid(&env.format),
        (Inf { sign }, _) | (_, Inf { sign }) => infinite(&env.format, sign),
    }
}
