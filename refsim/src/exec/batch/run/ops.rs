//! Lane operations: what decoded programs consist of, and the loops that carry them out.

use super::loops::{
    address, bitwise, compare, difference, dot, dot_by, narrow, one, or_less, select, three, two, widen,
};
use super::pack::{fraction, join, signed, split, unsigned};
use super::slots::Slots;
use crate::exec::batch::lanes::{AnyLane, LANES, Lane, LaneRow, SimdLevel, with_any_lane};
use crate::exec::batch::schedule::LaneOp;
use crate::exec::lower::NodeOperation;

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
            NodeOperation::Dot(2) => dot::<L, 2>(op, slots, |a, b| lane.exact_dot(a, b)),
            NodeOperation::Dot(3) => dot::<L, 3>(op, slots, |a, b| lane.exact_dot(a, b)),
            NodeOperation::Dot(_) => dot::<L, 4>(op, slots, |a, b| lane.exact_dot(a, b)),
            NodeOperation::Sum(2) => dot::<L, 2>(op, slots, |a, b| lane.sum(a, b)),
            NodeOperation::Sum(3) => dot::<L, 3>(op, slots, |a, b| lane.sum(a, b)),
            NodeOperation::Sum(_) => dot::<L, 4>(op, slots, |a, b| lane.sum(a, b)),
            NodeOperation::Difference => {
                dot::<L, 2>(op, slots, |[a, c], [b, d]| lane.add(lane.mul(a, b), lane.neg(lane.mul(c, d))));
            }
            NodeOperation::SumBy(1) => dot_by::<L, 1>(op, slots, |a, b| lane.sum(a, b)),
            NodeOperation::SumBy(2) => dot_by::<L, 2>(op, slots, |a, b| lane.sum(a, b)),
            NodeOperation::SumBy(3) => dot_by::<L, 3>(op, slots, |a, b| lane.sum(a, b)),
            NodeOperation::SumBy(_) => dot_by::<L, 4>(op, slots, |a, b| lane.sum(a, b)),
            _ => step(lane, op, slots),
        }
    }
}

#[inline(always)]
fn step<L: Lane>(l: &L, op: &LaneOp, slots: &mut Slots) {
    let Slots { rows, scratch, values, wide, .. } = slots;
    let (out, wide): (&mut LaneRow, &mut [f64; LANES]) = (scratch, wide);
    let [a, b, c] = [0, 1, 2].map(|k| &**rows[usize::from(op.args[k])]);
    let uniform = L::load(values[usize::from(op.args[0])]);
    match op.code {
        NodeOperation::Add => two::<L>(a, b, out, |a, b| l.add(a, b)),
        NodeOperation::Sub => two::<L>(a, b, out, |a, b| l.sub(a, b)),
        NodeOperation::Mul => two::<L>(a, b, out, |a, b| l.mul(a, b)),
        NodeOperation::AddTo => one::<L>(b, out, |b| l.add(uniform, b)),
        NodeOperation::SubFrom => one::<L>(b, out, |b| l.sub(uniform, b)),
        NodeOperation::SubOff => one::<L>(b, out, |b| l.sub(b, uniform)),
        NodeOperation::MadBy => two::<L>(b, c, out, |b, c| l.add(l.mul(uniform, b), c)),
        NodeOperation::Div => two::<L>(a, b, out, |a, b| l.div(a, b)),
        NodeOperation::Mad => three::<L>(a, b, c, out, |a, b, c| l.add(l.mul(a, b), c)),
        NodeOperation::FusedMad => three::<L>(a, b, c, out, |a, b, c| l.fused_mad(a, b, c)),
        NodeOperation::Min => two::<L>(a, b, out, |a, b| l.min(a, b)),
        NodeOperation::Max => two::<L>(a, b, out, |a, b| l.max(a, b)),
        NodeOperation::Neg => one::<L>(a, out, |a| l.neg(a)),
        NodeOperation::Abs => one::<L>(a, out, |a| l.abs(a)),
        NodeOperation::Floor => one::<L>(a, out, |a| l.floor(a)),
        NodeOperation::Frc => one::<L>(a, out, |a| l.frc(a)),
        NodeOperation::Rcp => one::<L>(a, out, |a| l.rcp(a)),
        NodeOperation::Rsq => one::<L>(a, out, |a| l.rsq(a)),
        NodeOperation::Exp2 => one::<L>(a, out, |a| l.exp2(a)),
        NodeOperation::Log2 => one::<L>(a, out, |a| l.log2(a)),
        NodeOperation::Saturate => one::<L>(a, out, |a| l.saturate(a)),
        NodeOperation::Scale(shift) => {
            let shift = i32::from(shift);
            one::<L>(a, out, |a| l.scale(a, shift));
        }
        NodeOperation::Factor => two::<L>(a, b, out, |a, b| l.factor(a, b)),
        NodeOperation::SelectNonNegative => {
            let zero = L::load(0);
            three::<L>(a, b, c, out, |a, b, c| if l.le(zero, a) { b } else { c });
        }
        NodeOperation::SelectAboveHalf => three::<L>(a, b, c, out, |a, b, c| if l.above_half(a) { b } else { c }),
        NodeOperation::Less => compare::<L>(a, b, out, |a, b| l.lt(a, b)),
        NodeOperation::LessEqual => compare::<L>(a, b, out, |a, b| l.le(a, b)),
        NodeOperation::Equal => compare::<L>(a, b, out, |a, b| l.eq(a, b)),
        NodeOperation::OrLess => or_less(l, a, b, c, out),
        NodeOperation::DifferenceX => difference(l, a, out, 1),
        NodeOperation::DifferenceY => difference(l, a, out, 16),
        NodeOperation::AddressFloor => {
            for i in 0..LANES {
                out[i] = address(l.to_f64(l.floor(L::load(a[i]))).trunc());
            }
        }
        NodeOperation::AddressNearest => {
            for i in 0..LANES {
                let integer = l.to_f64(L::load(a[i])).round_ties_even();
                out[i] = address(l.to_f64(l.round_f64(integer)).trunc());
            }
        }
        NodeOperation::Widen => {
            widen(l, a, wide);
            return;
        }
        NodeOperation::Narrow => {
            narrow(l, wide, out);
        }
        NodeOperation::JoinPattern(shift) => {
            for i in 0..LANES {
                out[i] = a[i] | (l.encode(L::load(b[i])) & 0xffff) << shift;
            }
        }
        NodeOperation::JoinShort(shift) => join::<L>(a, b, out, shift, |x| unsigned(l.to_f64(x), 65535.0)),
        NodeOperation::JoinByte(shift) => join::<L>(a, b, out, shift, |x| unsigned(l.to_f64(x), 255.0)),
        NodeOperation::JoinSignedByte(shift) => join::<L>(a, b, out, shift, |x| signed(l.to_f64(x))),
        NodeOperation::SplitPattern(shift) => split::<L>(a, out, |word| l.decode(word >> shift & 0xffff)),
        NodeOperation::SplitShort(shift) => {
            split::<L>(a, out, |word| l.round_f64(fraction(word >> shift & 0xffff, 65535.0)))
        }
        NodeOperation::SplitByte(shift) => {
            split::<L>(a, out, |word| l.round_f64(fraction(word >> shift & 0xff, 255.0)))
        }
        NodeOperation::SplitSignedByte(shift) => split::<L>(a, out, |word| {
            let k = word >> shift & 0xff;
            let magnitude = fraction(k.abs_diff(128), 127.0);
            l.round_f64(if k < 128 { -magnitude } else { magnitude })
        }),
        NodeOperation::ToBits => {
            for i in 0..LANES {
                out[i] = l.encode(L::load(a[i]));
            }
        }
        NodeOperation::FromBits => split::<L>(a, out, |word| l.decode(word)),
        NodeOperation::Select => {
            select(a, b, c, out);
        }
        NodeOperation::And => bitwise(a, b, out, |a, b| a & b),
        NodeOperation::Or => bitwise(a, b, out, |a, b| a | b),
        NodeOperation::AndNot => bitwise(a, b, out, |a, b| !a & b),
        // Carried out by the caller.
        NodeOperation::Dot(_) | NodeOperation::Sum(_) | NodeOperation::SumBy(_) | NodeOperation::Difference => {}
    }
    slots.commit(op.to);
}
