//! Lane operations: what decoded programs consist of, and the loops that carry them out.

use super::lane::{LANES, Lane};
use super::lanes::{AnyLane, with_any_lane};
use super::simd::SimdLevel;
use super::slots::{Row, Slot, Slots, TRUE};

/// What an operation computes from up to three rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Code {
    Add,
    Sub,
    Mul,
    Div,
    /// Product and sum, rounded one after the other.
    Mad,
    FusedMad,
    Min,
    Max,
    Neg,
    Abs,
    Floor,
    Frc,
    Rcp,
    Rsq,
    Exp2,
    Log2,
    Saturate,
    /// Times two to this power.
    Scale(i8),
    /// `a`, or 0 where the legacy rule for zero times anything replaces both factors `a` and `b`.
    Factor,
    /// `a >= 0 ? b : c`
    SelectNonNegative,
    /// `a > 1/2 ? b : c`
    SelectAboveHalf,
    /// Mask of `a < b`, `a <= b`, `a == b`.
    Less,
    LessEqual,
    Equal,
    /// Right neighbour less left one, for both; lower less upper.
    DifferenceX,
    DifferenceY,
    /// `a` rounded down or to the nearest even integer in the format, as a saturated integer.
    AddressFloor,
    AddressNearest,
    /// `a` into the wide row; the wide row, rounded, into the destination.
    Widen,
    Narrow,
    /// Mask operations: `a ? b : c`, and, or, `b and not a`.
    Select,
    And,
    Or,
    AndNot,
}

/// One operation on whole rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LaneOp {
    pub(crate) code: Code,
    pub(crate) to: Slot,
    pub(crate) a: Slot,
    pub(crate) b: Slot,
    pub(crate) c: Slot,
}

/// A dot product that is rounded once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DotOp {
    pub(crate) to: Slot,
    pub(crate) terms: usize,
    pub(crate) a: [Slot; 4],
    pub(crate) b: [Slot; 4],
}

/// Runs operations in the arithmetic of a format. The one place where a processor's vector width is chosen.
pub(crate) fn run(lane: &AnyLane, simd: SimdLevel, ops: &[LaneOp], slots: &mut Slots) {
    with_any_lane!(lane, |lane| {
        simd.run(
            #[inline(always)]
            || run_lanes(lane, ops, slots),
        )
    });
}

/// As [`run`], for a dot product.
pub(crate) fn run_dot(lane: &AnyLane, simd: SimdLevel, op: &DotOp, slots: &mut Slots) {
    with_any_lane!(lane, |lane| {
        simd.run(
            #[inline(always)]
            || dot_lanes(lane, op, slots),
        )
    });
}

#[inline(always)]
fn run_lanes<L: Lane>(lane: &L, ops: &[LaneOp], slots: &mut Slots) {
    for op in ops {
        step(lane, op, slots);
    }
}

#[inline(always)]
fn dot_lanes<L: Lane>(lane: &L, op: &DotOp, slots: &mut Slots) {
    let row = |k: usize| (&*slots.rows[usize::from(op.a[k])], &*slots.rows[usize::from(op.b[k])]);
    match op.terms {
        2 => exact(lane, [row(0), row(1)], &mut slots.scratch),
        3 => exact(lane, [row(0), row(1), row(2)], &mut slots.scratch),
        _ => exact(lane, [row(0), row(1), row(2), row(3)], &mut slots.scratch),
    }
    slots.commit(op.to);
}

#[inline(always)]
fn exact<L: Lane, const N: usize>(lane: &L, rows: [(&Row, &Row); N], out: &mut Row) {
    for (i, slot) in out.iter_mut().enumerate() {
        let mut a = [L::load(0); N];
        let mut b = a;
        for k in 0..N {
            a[k] = L::load(rows[k].0[i]);
            b[k] = L::load(rows[k].1[i]);
        }
        *slot = L::store(lane.exact_dot(a, b));
    }
}

#[inline(always)]
fn one<L: Lane>(a: &Row, out: &mut Row, f: impl Fn(L::T) -> L::T) {
    for i in 0..LANES {
        out[i] = L::store(f(L::load(a[i])));
    }
}

#[inline(always)]
fn two<L: Lane>(a: &Row, b: &Row, out: &mut Row, f: impl Fn(L::T, L::T) -> L::T) {
    for i in 0..LANES {
        out[i] = L::store(f(L::load(a[i]), L::load(b[i])));
    }
}

#[inline(always)]
fn three<L: Lane>(a: &Row, b: &Row, c: &Row, out: &mut Row, f: impl Fn(L::T, L::T, L::T) -> L::T) {
    for i in 0..LANES {
        out[i] = L::store(f(L::load(a[i]), L::load(b[i]), L::load(c[i])));
    }
}

#[inline(always)]
fn compare<L: Lane>(a: &Row, b: &Row, out: &mut Row, f: impl Fn(L::T, L::T) -> bool) {
    for i in 0..LANES {
        out[i] = if f(L::load(a[i]), L::load(b[i])) { TRUE } else { 0 };
    }
}

#[inline(always)]
fn bitwise(a: &Row, b: &Row, out: &mut Row, f: impl Fn(u32, u32) -> u32) {
    for i in 0..LANES {
        out[i] = f(a[i], b[i]);
    }
}

/// Lane partners: the lower and the higher lane of a pair that differs in `bit` of its number.
#[inline(always)]
fn difference<L: Lane>(lane: &L, a: &Row, out: &mut Row, bit: usize) {
    for i in 0..LANES {
        out[i] = L::store(lane.sub(L::load(a[i | bit]), L::load(a[i & !bit])));
    }
}

/// An integer in a double as an address; NaN gives 0.
fn address(x: f64) -> u32 {
    (x as i32).cast_unsigned()
}

#[inline(always)]
fn step<L: Lane>(l: &L, op: &LaneOp, slots: &mut Slots) {
    let Slots { rows, scratch: out, wide } = slots;
    let (a, b, c) = (&*rows[usize::from(op.a)], &*rows[usize::from(op.b)], &*rows[usize::from(op.c)]);
    match op.code {
        Code::Add => two::<L>(a, b, out, |a, b| l.add(a, b)),
        Code::Sub => two::<L>(a, b, out, |a, b| l.sub(a, b)),
        Code::Mul => two::<L>(a, b, out, |a, b| l.mul(a, b)),
        Code::Div => two::<L>(a, b, out, |a, b| l.div(a, b)),
        Code::Mad => three::<L>(a, b, c, out, |a, b, c| l.add(l.mul(a, b), c)),
        Code::FusedMad => three::<L>(a, b, c, out, |a, b, c| l.fused_mad(a, b, c)),
        Code::Min => two::<L>(a, b, out, |a, b| l.min(a, b)),
        Code::Max => two::<L>(a, b, out, |a, b| l.max(a, b)),
        Code::Neg => one::<L>(a, out, |a| l.neg(a)),
        Code::Abs => one::<L>(a, out, |a| l.abs(a)),
        Code::Floor => one::<L>(a, out, |a| l.floor(a)),
        Code::Frc => one::<L>(a, out, |a| l.frc(a)),
        Code::Rcp => one::<L>(a, out, |a| l.rcp(a)),
        Code::Rsq => one::<L>(a, out, |a| l.rsq(a)),
        Code::Exp2 => one::<L>(a, out, |a| l.exp2(a)),
        Code::Log2 => one::<L>(a, out, |a| l.log2(a)),
        Code::Saturate => one::<L>(a, out, |a| l.saturate(a)),
        Code::Scale(shift) => {
            let shift = i32::from(shift);
            one::<L>(a, out, |a| l.scale(a, shift));
        }
        Code::Factor => two::<L>(a, b, out, |a, b| l.factor(a, b)),
        Code::SelectNonNegative => {
            let zero = L::load(0);
            three::<L>(a, b, c, out, |a, b, c| if l.le(zero, a) { b } else { c });
        }
        Code::SelectAboveHalf => three::<L>(a, b, c, out, |a, b, c| if l.above_half(a) { b } else { c }),
        Code::Less => compare::<L>(a, b, out, |a, b| l.lt(a, b)),
        Code::LessEqual => compare::<L>(a, b, out, |a, b| l.le(a, b)),
        Code::Equal => compare::<L>(a, b, out, |a, b| l.eq(a, b)),
        Code::DifferenceX => difference(l, a, out, 1),
        Code::DifferenceY => difference(l, a, out, 16),
        Code::AddressFloor => {
            for i in 0..LANES {
                out[i] = address(l.to_f64(l.floor(L::load(a[i]))).trunc());
            }
        }
        Code::AddressNearest => {
            for i in 0..LANES {
                let integer = l.to_f64(L::load(a[i])).round_ties_even();
                out[i] = address(l.to_f64(l.round_f64(integer)).trunc());
            }
        }
        Code::Widen => {
            for i in 0..LANES {
                wide[i] = l.to_f64(L::load(a[i]));
            }
            return;
        }
        Code::Narrow => {
            for i in 0..LANES {
                out[i] = L::store(l.round_f64(wide[i]));
            }
        }
        Code::Select => {
            for i in 0..LANES {
                out[i] = if a[i] != 0 { b[i] } else { c[i] };
            }
        }
        Code::And => bitwise(a, b, out, |a, b| a & b),
        Code::Or => bitwise(a, b, out, |a, b| a | b),
        Code::AndNot => bitwise(a, b, out, |a, b| !a & b),
    }
    slots.commit(op.to);
}
