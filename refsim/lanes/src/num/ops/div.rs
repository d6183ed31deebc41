//! Division and the reciprocal.

use crate::num::env::Env;
use crate::num::flags::Outcome;
use crate::num::round::{divide_by_zero, infinite, round_quotient, zero};
use crate::num::unit;
use crate::num::unit::UnitOperation;
use crate::num::unpack::{Unpacked, invalid, nan_result, unpack};

/// `a / b`. A finite nonzero `a` over zero is `DIVIDE_BY_ZERO`, and gives infinity with the quotient's sign. Without
/// infinity it gives NaN. Without both, and in fixed point (even if it wraps) and `:sat` floats, it gives the end of
/// the range on the side of the quotient. `0/0` and `inf/inf` are `INVALID`, and 0 in fixed point.
pub fn div(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    let env = env.into();
    div_values(&env, unpack(&env.format, a), unpack(&env.format, b))
}

/// `1 / x`, rounded once; the dividend 1 is exact even in formats that can't represent it. `1 / 0` as in [`div`]; in
/// fixed point it gives the largest number.
pub fn rcp(env: impl Into<Env>, x: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Rcp, &[x]) {
        return done;
    }
    div_values(&env, Unpacked::Finite { sign: false, sig: 1, exp: 0, den: 1 }, unpack(&env.format, x))
}

fn div_values(env: &Env, a: Unpacked, b: Unpacked) -> Outcome {
    use Unpacked::{Finite, Inf, Nan};
    let format = &env.format;
    match (a, b) {
        (Nan { .. }, _) | (_, Nan { .. }) => nan_result(format, &[a, b]),
        (Inf { .. }, Inf { .. }) | (Finite { sig: 0, .. }, Finite { sig: 0, .. }) => invalid(format),
        (Inf { sign: sa }, Finite { sign: sb, .. }) => infinite(format, sa != sb),
        (Finite { sign: sa, .. }, Inf { sign: sb }) => zero(format, sa != sb),
        (Finite { sign: sa, .. }, Finite { sign: sb, sig: 0, .. }) => divide_by_zero(format, sa != sb),
        (Finite { sign: sa, sig: 0, .. }, Finite { sign: sb, .. }) => zero(format, sa != sb),
        (Finite { sign: sa, sig: ma, exp: ea, den: da }, Finite { sign: sb, sig: mb, exp: eb, den: db }) => {
            round_quotient(env, sa != sb, ma * u64::from(db), ea - eb, mb * u64::from(da))
        }
    }
}
