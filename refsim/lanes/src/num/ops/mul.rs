//! Multiplication.

use crate::num::env::Env;
use crate::num::flags::Outcome;
use crate::num::round::{from_parts, infinite, round_quotient};
use crate::num::unit;
use crate::num::unit::UnitOperation;
use crate::num::unpack::{Unpacked, invalid, nan_result, unpack};

/// `a * b`. `0 * inf` is `INVALID`.
pub fn mul(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Mul, &[a, b]) {
        return done;
    }
    product(&env, unpack(&env.format, a), unpack(&env.format, b))
}

/// The product of two numbers of the same format; the result may have another format.
pub(crate) fn product(env: &Env, a: Unpacked, b: Unpacked) -> Outcome {
    use Unpacked::{Finite, Inf, Nan};
    match (a, b) {
        (Finite { sign: sa, sig: ma, exp: ea, den: 1 }, Finite { sign: sb, sig: mb, exp: eb, .. })
            if env.format.denominator() != 1 =>
        {
            from_parts(*env, sa != sb, u128::from(ma * mb), ea + eb, false)
        }
        (Finite { sign: sa, sig: ma, exp: ea, den: da }, Finite { sign: sb, sig: mb, exp: eb, den: db }) => {
            // The product of the significands is at most 2^31 * 2^31, or 2^15 * 2^15 over a denominator.
            round_quotient(env, sa != sb, ma * mb, ea + eb, u64::from(da) * u64::from(db))
        }
        (Nan { .. }, _) | (_, Nan { .. }) => nan_result(&env.format, &[a, b]),
        (Inf { .. }, Finite { sig: 0, .. }) | (Finite { sig: 0, .. }, Inf { .. }) => invalid(&env.format),
        (Inf { sign: sa }, Inf { sign: sb } | Finite { sign: sb, .. })
        | (Finite { sign: sa, .. }, Inf { sign: sb }) => infinite(&env.format, sa != sb),
    }
}
