//! Minimum, maximum, and the two conditional selects of the shading languages.
//!
//! Selected values are normalised: NaNs become canonical, and subnormals are flushed where the format flushes. Units of
//! cards compare in their own order, and the conditional selects copy words unchanged.

use std::cmp::Ordering;

use super::compare::order;
use crate::num::env::Env;
use crate::num::flags::{Flags, Outcome};
use crate::num::format::FormatKind;
use crate::num::rules::Specials;
use crate::num::unit;
use crate::num::unit::UnitOperation;
use crate::num::unpack::{key, nan_bits, pass};

/// `a < b ? a : b` (Direct3D 9 `min`), so a NaN on either side, and a pair of zeros, give `b`; with [`Specials::Nv`] a
/// NaN on either side gives NaN, and -0 is less than +0. `INVALID` for signalling NaNs only.
pub fn min(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Min, &[a, b]) {
        return done;
    }
    choose(env, a, b, Ordering::is_lt)
}

/// `a >= b ? a : b` (Direct3D 9 `max`), so a NaN on either side gives `b`, and a pair of zeros gives `a`; with
/// [`Specials::Nv`] a NaN on either side gives NaN, and -0 is less than +0. `INVALID` for signalling NaNs only.
pub fn max(env: impl Into<Env>, a: u32, b: u32) -> Outcome {
    let env = env.into();
    if let Some(done) = unit::evaluate(&env.format, UnitOperation::Max, &[a, b]) {
        return done;
    }
    choose(env, a, b, Ordering::is_ge)
}

fn choose(env: Env, a: u32, b: u32, first: impl Fn(Ordering) -> bool) -> Outcome {
    let format = &env.format;
    let (order, signaling) = order(&env, a, b);
    let nv = format.specials == Specials::Nv;
    let bits = match order {
        None if nv => nan_bits(format),
        // Equal numbers differ only in the sign of zeros: the maximum is -0 only if both are -0.
        Some(Ordering::Equal) if nv && first(Ordering::Equal) => pass(format, a) & pass(format, b),
        Some(Ordering::Equal) if nv => pass(format, a) | pass(format, b),
        Some(order) if first(order) => pass(format, a),
        _ => pass(format, b),
    };
    Outcome::new(bits, if signaling { Flags::INVALID } else { Flags::empty() })
}

/// `cond >= 0 ? a : b`. -0 counts as zero, a NaN condition selects `b`. Raises nothing.
pub fn cmp(env: impl Into<Env>, cond: u32, a: u32, b: u32) -> Outcome {
    let format = env.into().format;
    if format.unit.is_card() {
        return Outcome::exact(if reaches(&format, cond, 0, Ordering::is_ge) { a } else { b });
    }
    let first = !format.is_nan(cond) && key(&format, cond) >= 0;
    Outcome::exact(pass(&format, if first { a } else { b }))
}

/// `cond > 0.5 ? a : b`. The half is exact even in formats that can't hold it; a NaN condition selects `b`. Raises
/// nothing.
pub fn cnd(env: impl Into<Env>, cond: u32, a: u32, b: u32) -> Outcome {
    let format = env.into().format;
    if format.unit.is_card() {
        return Outcome::exact(if reaches(&format, cond, half(&format), Ordering::is_gt) { a } else { b });
    }
    let first = match format.kind {
        FormatKind::Fixed { frac_bits, .. } => 2 * key(&format, cond) > 1 << frac_bits,
        FormatKind::Normalized { .. } => 2 * key(&format, cond) > i64::from(format.denominator()),
        FormatKind::Float { .. } => !format.is_nan(cond) && key(&format, cond) > i64::from(half(&format)),
    };
    Outcome::exact(pass(&format, if first { a } else { b }))
}

/// Compares a condition with a bound, in the order of a card's unit.
fn reaches(format: &crate::num::Format, condition: u32, bound: u32, holds: impl Fn(Ordering) -> bool) -> bool {
    unit::order(format.unit, condition, bound).is_some_and(holds)
}

/// The pattern of 0.5 in a float. Every float represents 0.5; with bias 1 it is subnormal.
fn half(format: &crate::num::Format) -> u32 {
    match format.kind {
        FormatKind::Float { man_bits, .. } if format.one() == 1 << man_bits => 1 << (man_bits - 1),
        FormatKind::Float { man_bits, .. } => format.one() - (1 << man_bits),
        FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => 0,
    }
}
