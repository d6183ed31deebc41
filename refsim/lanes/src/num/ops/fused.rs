//! Multiply-add with two roundings and with one.

use super::{add, mul};
use crate::num::env::Env;
use crate::num::flags::Outcome;
use crate::num::round::infinite;
use crate::num::sum::{Term, sum_over};
use crate::num::unit;
use crate::num::unit::UnitOperation;
use crate::num::unpack::{Unpacked, invalid, nan_result, unpack};

/// `a * b + c` with product and sum each rounded: the cards' multiply-add.
pub fn mad(env: impl Into<Env>, a: u32, b: u32, c: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Mad, &[a, b, c]) {
        return done;
    }
    let product = mul(env, a, b);
    add(env, product.bits, c).also(product.flags)
}

/// `a * b + c`, rounded once. `0 * inf + c` is `INVALID` even for a quiet NaN `c`: IEEE 754 leaves this open; SoftFloat
/// and RISC-V do the same.
pub fn fused_mad(env: impl Into<Env>, a: u32, b: u32, c: u32) -> Outcome {
    use Unpacked::{Finite, Inf, Nan};
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::FusedMad, &[a, b, c]) {
        return done;
    }
    let format = &env.format;
    let (a, b, c) = (unpack(format, a), unpack(format, b), unpack(format, c));
    let product = match (a, b) {
        (Nan { .. }, _) | (_, Nan { .. }) => return nan_result(format, &[a, b, c]),
        (Inf { .. }, Finite { sig: 0, .. }) | (Finite { sig: 0, .. }, Inf { .. }) => return invalid(format),
        (Finite { sign: sa, sig: ma, exp: ea, den }, Finite { sign: sb, sig: mb, exp: eb, .. }) => {
            Finite { sign: sa != sb, sig: ma * mb, exp: ea + eb, den }
        }
        (Inf { sign: sa }, Inf { sign: sb } | Finite { sign: sb, .. })
        | (Finite { sign: sa, .. }, Inf { sign: sb }) => Inf { sign: sa != sb },
    };
    match (product, c) {
        (_, Nan { .. }) => nan_result(format, &[c]),
        (Finite { sign: sp, sig: mp, exp: ep, .. }, Finite { sign: sc, sig: mc, exp: ec, den }) => {
            let addend = Term { sign: sc, sig: mc * u64::from(den), exp: ec };
            sum_over(&env, Term { sign: sp, sig: mp, exp: ep }, addend, u64::from(den) * u64::from(den))
        }
        (Inf { sign: sp }, Inf { sign: sc }) if sp != sc => invalid(format),
        (Inf { sign }, _) | (_, Inf { sign }) => infinite(format, sign),
        (Nan { .. }, _) => nan_result(format, &[product]),
    }
}
