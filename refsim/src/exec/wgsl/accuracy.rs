//! Accuracy that WGSL requires of an adapter's own `f32` operations.
//!
//! Source: "WebGPU Shading Language", sections 15.7 (floating point evaluation: subnormal numbers may be flushed on the
//! way in and out, results of infinite or NaN operands and of overflow are indeterminate, multiply and add may be
//! fused) and 15.7.4 (accuracy: add, subtract, multiply correctly rounded, which means either neighbour of an inexact
//! result; divide 2.5 ULP for divisors from 2^-126 to 2^126; `inverseSqrt` 2 ULP; `sqrt` as `1 / inverseSqrt`).

use serde::Serialize;

use crate::num::{Flags, Format, NumberOperation, Rounding, from_ratio, ops};

const FP32: Format = Format::FP32;
/// Rounding down, for the neighbours of an exact result.
const BELOW: Format = FP32.with_rounding(Rounding::Down);

/// A single-precision operation of an adapter.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u32)]
pub enum SingleOperation {
    /// `a + b`
    Add,
    /// `a - b`
    Sub,
    /// `a b`
    Mul,
    /// `a b + c` as a shader writes it: two roundings, unless the compiler fuses them.
    MulAdd,
    /// `a / b`
    Div,
    /// `1 / a`
    Rcp,
    /// Square root.
    Sqrt,
    /// Rounds down to an integer.
    Floor,
    /// Converts an `i32`.
    FromInteger,
    /// The smaller number.
    Min,
    /// The larger number.
    Max,
}

impl SingleOperation {
    /// All operations, in the order of their numbers.
    pub const ALL: [SingleOperation; 11] = [
        Self::Add,
        Self::Sub,
        Self::Mul,
        Self::MulAdd,
        Self::Div,
        Self::Rcp,
        Self::Sqrt,
        Self::Floor,
        Self::FromInteger,
        Self::Min,
        Self::Max,
    ];

    /// Number of operands.
    pub const fn arity(self) -> usize {
        match self {
            Self::FromInteger => 1,
            _ => self.operation().operands(),
        }
    }

    /// Name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Add => "add",
            Self::Sub => "sub",
            Self::Mul => "mul",
            Self::MulAdd => "mul then add",
            Self::Div => "div",
            Self::Rcp => "reciprocal",
            Self::Sqrt => "sqrt",
            Self::Floor => "floor",
            Self::FromInteger => "from integer",
            Self::Min => "min",
            Self::Max => "max",
        }
    }

    /// The equivalent [`NumberOperation`].
    pub const fn operation(self) -> NumberOperation {
        match self {
            Self::Add => NumberOperation::Add,
            Self::Sub => NumberOperation::Sub,
            Self::Mul => NumberOperation::Mul,
            Self::MulAdd => NumberOperation::Mad,
            Self::Div => NumberOperation::Div,
            Self::Rcp => NumberOperation::Rcp,
            Self::Sqrt => NumberOperation::Sqrt,
            Self::Floor => NumberOperation::Floor,
            Self::FromInteger => NumberOperation::Convert,
            Self::Min => NumberOperation::Min,
            Self::Max => NumberOperation::Max,
        }
    }

    /// IEEE 754 result with canonical NaN, as computed by [`crate::num::ops`].
    pub fn exact(self, operands: [u32; 3]) -> u32 {
        self.rounded(&FP32, operands)
    }

    /// Result rounded by `format`'s rules; for [`Self::MulAdd`] each step.
    fn rounded(self, format: &Format, operands: [u32; 3]) -> u32 {
        let integer = operands[0].cast_signed();
        let outcome = match self {
            Self::FromInteger => Some(from_ratio(format, integer < 0, integer.unsigned_abs().into(), 1)),
            _ => self.operation().evaluate(format, operands),
        };
        outcome.map_or(0, |outcome| outcome.bits)
    }
}

/// Results that WGSL allows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Allowed {
    /// Any bits.
    Any,
    /// Numbers within any of these inclusive ranges of [`order`]; both zeros are equal.
    Within(Vec<(i64, i64)>),
}

impl Allowed {
    /// Returns `true` if a result is allowed.
    pub fn contains(&self, bits: u32) -> bool {
        match self {
            Allowed::Any => true,
            Allowed::Within(ranges) => {
                !FP32.is_nan(bits) && ranges.iter().any(|&(low, high)| (low..=high).contains(&order(bits)))
            }
        }
    }
}

/// Maps single-precision numbers to consecutive integers; both zeros map to 0. Differences are distances in units in
/// the last place.
pub fn order(bits: u32) -> i64 {
    let magnitude = i64::from(bits & 0x7fff_ffff);
    if bits >> 31 == 1 { -magnitude } else { magnitude }
}

/// Inverse of [`order`].
fn at(order: i64) -> u32 {
    let magnitude = order.unsigned_abs() as u32;
    if order < 0 { magnitude | 1 << 31 } else { magnitude }
}

fn negated(bits: u32) -> u32 {
    bits ^ 1 << 31
}

/// Neighbours of the exact result; equal if it is representable. Rounding up is computed as rounding the negated
/// operation down.
fn neighbours(operation: SingleOperation, [a, b, c]: [u32; 3]) -> (i64, i64) {
    use SingleOperation as Op;
    let low = operation.rounded(&BELOW, [a, b, c]);
    let mirrored = match operation {
        Op::Add | Op::Sub => [negated(a), negated(b), c],
        Op::Mul | Op::Div | Op::Rcp => [negated(a), b, c],
        Op::MulAdd => [negated(a), b, negated(c)],
        // Computed separately: see below.
        Op::Sqrt | Op::Floor | Op::Min | Op::Max => return (order(low), order(low)),
        Op::FromInteger => [a.wrapping_neg(), b, c],
    };
    (order(low), -order(operation.rounded(&BELOW, mirrored)))
}

/// Widens a pair of neighbours by `units` units in the last place, and half a unit more if `half`.
///
/// Units are those of the larger binade involved; below a power of two, numbers are twice as dense.
fn widened((low, high): (i64, i64), units: i64, half: bool) -> (i64, i64) {
    let close = |place: i64| if (place.unsigned_abs() & 0x007f_ffff) <= 4 { 2 } else { 1 };
    let reach = if low == high { units } else { units - 1 + i64::from(half) };
    (low - reach * close(low), high + reach * close(high))
}

/// Allowed results for finite operands.
fn plain(operation: SingleOperation, operands: [u32; 3]) -> Option<(i64, i64)> {
    let magnitude = |bits: u32| bits & 0x7fff_ffff;
    // 2^-126 and 2^126.
    let divisible = |bits: u32| (0x0080_0000..=0x7e80_0000).contains(&magnitude(bits));
    match operation {
        SingleOperation::Div => divisible(operands[1]).then(|| widened(neighbours(operation, operands), 2, true)),
        SingleOperation::Rcp => divisible(operands[0]).then(|| widened(neighbours(operation, operands), 2, true)),
        SingleOperation::Sqrt if magnitude(operands[0]) == 0 => Some((0, 0)),
        SingleOperation::Sqrt => {
            if operands[0] >> 31 == 1 {
                return None;
            }
            let below = ops::rsq(BELOW, operands[0]);
            let low = order(below.bits);
            let inverse = widened((low, low + i64::from(below.flags.contains(Flags::INEXACT))), 2, false);
            let reciprocal = |place| widened(neighbours(SingleOperation::Rcp, [at(place), 0, 0]), 2, true);
            Some((reciprocal(inverse.1).0, reciprocal(inverse.0).1))
        }
        _ => Some(neighbours(operation, operands)),
    }
}

/// Returns `true` if a result in this range may be flushed.
fn may_be_subnormal((low, high): (i64, i64)) -> bool {
    let normal = order(0x0080_0000);
    low < normal && high > -normal
}

/// Results that WGSL allows for an operation on these bits (of `i32` for [`SingleOperation::FromInteger`]).
pub fn allowed(operation: SingleOperation, operands: [u32; 3]) -> Allowed {
    let used = &operands[..operation.arity()];
    let integer = operation == SingleOperation::FromInteger;
    if !integer && used.iter().any(|&bits| !FP32.is_finite(bits)) {
        return Allowed::Any;
    }
    let mut ranges = Vec::new();
    // Each subnormal operand unchanged, and flushed.
    for flushed in 0..1u32 << used.len() {
        let mut taken = operands;
        for (i, operand) in taken.iter_mut().enumerate().take(used.len()) {
            if flushed >> i & 1 == 1 && !integer {
                if !FP32.is_subnormal(*operand) {
                    continue;
                }
                *operand &= 1 << 31;
            }
        }
        // A product may be flushed before it is added, too.
        let product_flushed = [0, taken[1], taken[2]];
        let flushes = operation == SingleOperation::MulAdd && may_be_subnormal(neighbours(SingleOperation::Mul, taken));
        for taken in [taken].into_iter().chain(flushes.then_some(product_flushed)) {
            let Some((low, high)) = plain(operation, taken) else { return Allowed::Any };
            let infinity = order(0x7f80_0000);
            if low <= -infinity || high >= infinity {
                return Allowed::Any;
            }
            ranges.push((low, high));
            if may_be_subnormal((low, high)) {
                ranges.push((0, 0));
            }
        }
    }
    if matches!(operation, SingleOperation::Min | SingleOperation::Max) && used.iter().all(|&b| FP32.is_subnormal(b)) {
        ranges.extend(used.iter().map(|&b| (order(b), order(b))));
    }
    ranges.sort_unstable();
    ranges.dedup();
    Allowed::Within(ranges)
}
