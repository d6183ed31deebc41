//! Execution of the lane operations of decoded programs.

use super::apart::apart;
use super::code::{LaneCode, LaneOp};
use super::loops::{Largest, difference, dot, dot_by, largest_of, one, three, two};
use super::slots::Slots;
use super::{cards, guard, pack};
use crate::lanes::{AnyLane, Arithmetic, LANES, Lane, LaneRow, SimdLevel, is_finite, with_any_lane};
use crate::num::NumberOperation as Op;

/// Executes operations in the arithmetic of a format, with vector instructions of this level.
pub fn run(lane: &AnyLane, simd: SimdLevel, ops: &[LaneOp], slots: &mut Slots) {
    match lane.arithmetic() {
        Arithmetic::Nv(lane) => cards::run(lane, simd, ops, slots),
        Arithmetic::Gt200(lane) => cards::run(lane, simd, ops, slots),
        _ => with_any_lane!(lane, |lane| { run_at(lane, simd, ops, slots) }),
    }
}

/// One function per arithmetic and level: a single function for all would compile slowly.
#[inline(never)]
fn run_at<L: Lane>(lane: &L, simd: SimdLevel, ops: &[LaneOp], slots: &mut Slots) {
    if L::CARD {
        return;
    }
    if L::VECTORS {
        simd.run(
            #[inline(always)]
            || run_lanes(lane, simd, ops, slots),
        );
    } else {
        run_lanes(lane, simd, ops, slots);
    }
}

/// Inlining is forced: otherwise longer lane functions would be compiled for the baseline processor.
#[inline(always)]
fn run_lanes<L: Lane>(lane: &L, simd: SimdLevel, ops: &[LaneOp], slots: &mut Slots) {
    // Below this level, a fused multiply-add would be a function call.
    let fused = L::FUSED && lane.is_fused() && simd >= SimdLevel::Avx2;
    for op in ops {
        let largest = match op.code {
            LaneCode::Dot(2) => dot::<L, 2>(
                op,
                slots,
                #[inline(always)]
                |a, b| lane.exact_dot(a, b),
            ),
            LaneCode::Dot(3) => dot::<L, 3>(
                op,
                slots,
                #[inline(always)]
                |a, b| lane.exact_dot(a, b),
            ),
            LaneCode::Dot(_) => dot::<L, 4>(
                op,
                slots,
                #[inline(always)]
                |a, b| lane.exact_dot(a, b),
            ),
            LaneCode::Sum(2) => sum::<L, 2>(lane, fused, op, slots),
            LaneCode::Sum(3) => sum::<L, 3>(lane, fused, op, slots),
            LaneCode::Sum(_) => sum::<L, 4>(lane, fused, op, slots),
            LaneCode::Difference => dot::<L, 2>(
                op,
                slots,
                #[inline(always)]
                |[a, c], [b, d]| lane.add(lane.mul(a, b), lane.neg(lane.mul(c, d))),
            ),
            LaneCode::SumBy(1) => sum_by::<L, 1>(lane, fused, op, slots),
            LaneCode::SumBy(2) => sum_by::<L, 2>(lane, fused, op, slots),
            LaneCode::SumBy(3) => sum_by::<L, 3>(lane, fused, op, slots),
            LaneCode::SumBy(_) => sum_by::<L, 4>(lane, fused, op, slots),
            LaneCode::Widen => {
                let Slots { rows, wide, .. } = slots;
                lane.reading().row_to_f64(simd, &rows[usize::from(op.args[0])], wide);
                continue;
            }
            _ => step(lane, (simd, fused), op, slots),
        };
        if op.zero_wins || lane.is_guarded() && op.code.is_guarded() {
            // Loops of unguarded arithmetics don't compute the largest magnitude.
            let largest = if L::GUARDED { largest } else { largest_of(&slots.scratch) };
            if !is_finite(largest) {
                guard::mend(lane.general(), op, slots);
            }
        }
        slots.commit(op.to);
    }
}

/// Computes a sum of products of rows.
#[inline(always)]
fn sum<L: Lane, const N: usize>(lane: &L, fused: bool, op: &LaneOp, slots: &mut Slots) -> Largest {
    if L::FUSED && fused {
        return dot::<L, N>(
            op,
            slots,
            #[inline(always)]
            |a, b| lane.fused_sum(a, b),
        );
    }
    dot::<L, N>(
        op,
        slots,
        #[inline(always)]
        |a, b| lane.sum(a, b),
    )
}

/// Computes a sum of products of uniform values and rows.
#[inline(always)]
fn sum_by<L: Lane, const N: usize>(lane: &L, fused: bool, op: &LaneOp, slots: &mut Slots) -> Largest {
    if L::FUSED && fused {
        return dot_by::<L, N>(
            op,
            slots,
            #[inline(always)]
            |a, b| lane.fused_sum(a, b),
        );
    }
    dot_by::<L, N>(
        op,
        slots,
        #[inline(always)]
        |a, b| lane.sum(a, b),
    )
}

/// Executes an operation of the table, or one that reads neighbouring lanes. Returns 0 for an operation that is never
/// guarded.
#[inline(always)]
fn step<L: Lane>(l: &L, (simd, fused): (SimdLevel, bool), op: &LaneOp, slots: &mut Slots) -> Largest {
    let Slots { rows, scratch, values, wide, .. } = slots;
    let (out, wide): (&mut LaneRow, &[f64; LANES]) = (scratch, wide);
    let [a, b, c] = [0, 1, 2].map(|k| &**rows[usize::from(op.args[k])]);
    let uniform = L::load(values[usize::from(op.args[0])]);
    match op.code {
        LaneCode::Plain(Op::Add) => two::<L>(a, b, out, |a, b| l.add(a, b)),
        LaneCode::Plain(Op::Sub) => two::<L>(a, b, out, |a, b| l.sub(a, b)),
        LaneCode::Plain(Op::Mul) => two::<L>(a, b, out, |a, b| l.mul(a, b)),
        LaneCode::AddTo => one::<L>(b, out, |b| l.add(uniform, b)),
        LaneCode::SubFrom => one::<L>(b, out, |b| l.sub(uniform, b)),
        LaneCode::SubOff => one::<L>(b, out, |b| l.sub(b, uniform)),
        LaneCode::MadBy => two::<L>(b, c, out, |b, c| l.add(l.mul(uniform, b), c)),
        LaneCode::Plain(Op::Div) if L::FUSED && fused => two::<L>(a, b, out, |a, b| l.fused_div(a, b)),
        LaneCode::Plain(Op::Div) => two::<L>(a, b, out, |a, b| l.div(a, b)),
        LaneCode::Plain(Op::Mad) => three::<L>(a, b, c, out, |a, b, c| l.add(l.mul(a, b), c)),
        LaneCode::Plain(Op::FusedMad) => three::<L>(a, b, c, out, |a, b, c| l.fused_mad(a, b, c)),
        LaneCode::Plain(Op::Min) => two::<L>(a, b, out, |a, b| l.min(a, b)),
        LaneCode::Plain(Op::Max) => two::<L>(a, b, out, |a, b| l.max(a, b)),
        LaneCode::Plain(Op::Neg) => one::<L>(a, out, |a| l.neg(a)),
        LaneCode::Plain(Op::Abs) => one::<L>(a, out, |a| l.abs(a)),
        LaneCode::Plain(operation @ (Op::Floor | Op::AddressFloor)) => {
            let largest = one::<L>(a, out, |a| l.floor(a));
            if operation == Op::AddressFloor {
                pack::to_addresses(l.reading(), out);
            }
            largest
        }
        LaneCode::Plain(Op::Frc) => one::<L>(a, out, |a| l.frc(a)),
        LaneCode::Plain(Op::Rcp) => one::<L>(a, out, |a| l.rcp(a)),
        LaneCode::Plain(Op::Rsq) => one::<L>(a, out, |a| l.rsq(a)),
        LaneCode::Plain(Op::Exp2) => one::<L>(a, out, |a| l.exp2(a)),
        LaneCode::Plain(Op::Log2) => one::<L>(a, out, |a| l.log2(a)),
        LaneCode::Plain(Op::Saturate) => one::<L>(a, out, |a| l.saturate(a)),
        LaneCode::Immediate(Op::Scale, shift) => {
            let shift = i32::from(shift);
            one::<L>(a, out, |a| l.scale(a, shift))
        }
        LaneCode::Plain(Op::Factor) => two::<L>(a, b, out, |a, b| l.factor(a, b)),
        LaneCode::Plain(Op::SelectAboveHalf) => three::<L>(a, b, c, out, |a, b, c| if l.above_half(a) { b } else { c }),
        LaneCode::Neighbors(down) => difference(l, a, out, if down { 16 } else { 1 }),
        LaneCode::Plain(Op::Sqrt) => one::<L>(a, out, |a| l.sqrt(a)),
        code => {
            apart(l, simd, code, [a, b, c], wide, out);
            0
        }
    }
}
