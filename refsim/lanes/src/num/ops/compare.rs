//! Comparisons. The outcome's bits are 1 for true and 0 for false.

use std::cmp::Ordering;

use crate::num::env::Env;
use crate::num::flags::{Flags, Outcome};
use crate::num::unit;
use crate::num::unpack::{Unpacked, key, unpack};

/// Compares two values: returns their order (`None` with a NaN), and `true` if an operand is a signalling NaN.
pub(crate) fn order(env: &Env, a: u32, b: u32) -> (Option<Ordering>, bool) {
    let format = &env.format;
    if format.unit.is_card() {
        return (unit::order(format.unit, a, b), false);
    }
    if format.is_nan(a) || format.is_nan(b) {
        let signaling = |x| matches!(unpack(format, x), Unpacked::Nan { signaling: true });
        return (None, signaling(a) || signaling(b));
    }
    (Some(key(format, a).cmp(&key(format, b))), false)
}

/// Compares two values. If `quiet`, only signalling NaNs raise `INVALID`; else all NaNs do.
fn compare(env: Env, a: u32, b: u32, quiet: bool, holds: impl Fn(Ordering) -> bool) -> Outcome {
    let (order, signaling) = order(&env, a, b);
    let raise = signaling || (order.is_none() && !quiet);
    Outcome::new(u32::from(order.is_some_and(holds)), if raise { Flags::INVALID } else { Flags::empty() })
}

/// `a == b`; quiet, as TestFloat's `eq`.
pub fn eq(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    compare(env.into(), a, b, true, Ordering::is_eq)
}

/// `a < b`; any NaN raises `INVALID`, as TestFloat's `lt`.
pub fn lt(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    compare(env.into(), a, b, false, Ordering::is_lt)
}

/// `a < b`; quiet.
pub fn lt_quiet(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    compare(env.into(), a, b, true, Ordering::is_lt)
}

/// `a <= b`; any NaN raises `INVALID`, as TestFloat's `le`.
pub fn le(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    compare(env.into(), a, b, false, Ordering::is_le)
}

/// `a <= b`; quiet.
pub fn le_quiet(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    compare(env.into(), a, b, true, Ordering::is_le)
}
