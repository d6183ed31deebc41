//! Lane operations: what decoded programs consist of, and the loops that carry them out.

use super::lane::{LANES, Lane};
use super::lanes::{AnyLane, with_any_lane};
use super::loops::{
    address, bitwise, compare, difference, dot, dot_by, narrow, one, or_less, select, three, two, widen,
};
use super::pack::{fraction, join, signed, split, unsigned};
use super::simd::SimdLevel;
use super::slots::{Row, Slot, Slots};

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
    /// So many products, 2 to 4, summed exactly and rounded once.
    Dot(u8),
    /// So many products, 2 to 4, added in order, each product and each sum rounded.
    Sum(u8),
    /// Likewise, 1 to 4, with the first factor of each the same in all lanes.
    SumBy(u8),
    /// `a b - c d`, every step rounded.
    Difference,
    /// Operations whose `a` is the same in all lanes: `a + b`, `a - b`, `b - a`, `a b + c` in two roundings.
    AddTo,
    SubFrom,
    SubOff,
    MadBy,
    /// `a`, or the mask of `b < c`.
    OrLess,
    /// `a`, with `b` at this bit: its pattern of up to 16 bits; clamped to [0, 1] in 16 or 8 bits; from -1 to 1 in 8.
    JoinPattern(u8),
    JoinShort(u8),
    JoinByte(u8),
    JoinSignedByte(u8),
    /// What those put at this bit of `a`.
    SplitPattern(u8),
    SplitShort(u8),
    SplitByte(u8),
    SplitSignedByte(u8),
    /// The pattern of `a`, and the number of a pattern.
    ToBits,
    FromBits,
    /// Mask operations: `a ? b : c`, and, or, `b and not a`.
    Select,
    And,
    Or,
    AndNot,
}

/// Slots that an operation reads at most.
pub(crate) const OPERANDS: usize = 8;

/// One operation on whole rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LaneOp {
    pub(crate) code: Code,
    pub(crate) to: Slot,
    /// The operands `a`, `b`, `c`, or the factors of one product after the other.
    pub(crate) args: [Slot; OPERANDS],
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

#[inline(always)]
fn run_lanes<L: Lane>(lane: &L, ops: &[LaneOp], slots: &mut Slots) {
    for op in ops {
        match op.code {
            Code::Dot(2) => dot::<L, 2>(op, slots, |a, b| lane.exact_dot(a, b)),
            Code::Dot(3) => dot::<L, 3>(op, slots, |a, b| lane.exact_dot(a, b)),
            Code::Dot(_) => dot::<L, 4>(op, slots, |a, b| lane.exact_dot(a, b)),
            Code::Sum(2) => dot::<L, 2>(op, slots, |a, b| lane.sum(a, b)),
            Code::Sum(3) => dot::<L, 3>(op, slots, |a, b| lane.sum(a, b)),
            Code::Sum(_) => dot::<L, 4>(op, slots, |a, b| lane.sum(a, b)),
            Code::Difference => {
                dot::<L, 2>(op, slots, |[a, c], [b, d]| lane.add(lane.mul(a, b), lane.neg(lane.mul(c, d))));
            }
            Code::SumBy(1) => dot_by::<L, 1>(op, slots, |a, b| lane.sum(a, b)),
            Code::SumBy(2) => dot_by::<L, 2>(op, slots, |a, b| lane.sum(a, b)),
            Code::SumBy(3) => dot_by::<L, 3>(op, slots, |a, b| lane.sum(a, b)),
            Code::SumBy(_) => dot_by::<L, 4>(op, slots, |a, b| lane.sum(a, b)),
            _ => step(lane, op, slots),
        }
    }
}

#[inline(always)]
fn step<L: Lane>(l: &L, op: &LaneOp, slots: &mut Slots) {
    let Slots { rows, scratch, values, wide, .. } = slots;
    let (out, wide): (&mut Row, &mut [f64; LANES]) = (scratch, wide);
    let [a, b, c] = [0, 1, 2].map(|k| &**rows[usize::from(op.args[k])]);
    let uniform = L::load(values[usize::from(op.args[0])]);
    match op.code {
        Code::Add => two::<L>(a, b, out, |a, b| l.add(a, b)),
        Code::Sub => two::<L>(a, b, out, |a, b| l.sub(a, b)),
        Code::Mul => two::<L>(a, b, out, |a, b| l.mul(a, b)),
        Code::AddTo => one::<L>(b, out, |b| l.add(uniform, b)),
        Code::SubFrom => one::<L>(b, out, |b| l.sub(uniform, b)),
        Code::SubOff => one::<L>(b, out, |b| l.sub(b, uniform)),
        Code::MadBy => two::<L>(b, c, out, |b, c| l.add(l.mul(uniform, b), c)),
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
        Code::OrLess => or_less(l, a, b, c, out),
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
            widen(l, a, wide);
            return;
        }
        Code::Narrow => {
            narrow(l, wide, out);
        }
        Code::JoinPattern(shift) => {
            for i in 0..LANES {
                out[i] = a[i] | (l.encode(L::load(b[i])) & 0xffff) << shift;
            }
        }
        Code::JoinShort(shift) => join::<L>(a, b, out, shift, |x| unsigned(l.to_f64(x), 65535.0)),
        Code::JoinByte(shift) => join::<L>(a, b, out, shift, |x| unsigned(l.to_f64(x), 255.0)),
        Code::JoinSignedByte(shift) => join::<L>(a, b, out, shift, |x| signed(l.to_f64(x))),
        Code::SplitPattern(shift) => split::<L>(a, out, |word| l.decode(word >> shift & 0xffff)),
        Code::SplitShort(shift) => split::<L>(a, out, |word| l.round_f64(fraction(word >> shift & 0xffff, 65535.0))),
        Code::SplitByte(shift) => split::<L>(a, out, |word| l.round_f64(fraction(word >> shift & 0xff, 255.0))),
        Code::SplitSignedByte(shift) => split::<L>(a, out, |word| {
            let k = word >> shift & 0xff;
            let magnitude = fraction(k.abs_diff(128), 127.0);
            l.round_f64(if k < 128 { -magnitude } else { magnitude })
        }),
        Code::ToBits => {
            for i in 0..LANES {
                out[i] = l.encode(L::load(a[i]));
            }
        }
        Code::FromBits => split::<L>(a, out, |word| l.decode(word)),
        Code::Select => {
            select(a, b, c, out);
        }
        Code::And => bitwise(a, b, out, |a, b| a & b),
        Code::Or => bitwise(a, b, out, |a, b| a | b),
        Code::AndNot => bitwise(a, b, out, |a, b| !a & b),
        // Carried out by the caller.
        Code::Dot(_) | Code::Sum(_) | Code::SumBy(_) | Code::Difference => {}
    }
    slots.commit(op.to);
}
