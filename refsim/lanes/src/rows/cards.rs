//! Rows of the units of cards.
//!
//! Frequent operations are computed in vectorized loops. Lanes with a special value, or a magnitude at the end of the
//! range, are then recomputed.

use super::apart::apart;
use super::code::{LaneCode, LaneOp};
use super::pack;
use super::slots::Slots;
use crate::lanes::{CardLane, CardUnit, LANES, Lane, LaneRow, Met, SimdLevel, TRUE, without_small};
use crate::num::NumberOperation as Op;

const SIGN: u32 = 1 << 31;

/// Executes operations in the arithmetic of a unit, except fused codes.
#[inline(never)]
pub(super) fn run<U: CardUnit>(lane: &CardLane<U>, simd: SimdLevel, ops: &[LaneOp], slots: &mut Slots) {
    for op in ops {
        if matches!(op.code, LaneCode::Widen | LaneCode::WidenToHalf) {
            let Slots { rows, wide, .. } = slots;
            lane.reading().row_to_f64(simd, &rows[usize::from(op.args[0])], wide);
            if op.code == LaneCode::WidenToHalf {
                wide.iter_mut().for_each(|x| *x = without_small(*x));
            }
            continue;
        }
        let done = match simd {
            SimdLevel::Baseline => quick::<U, false>(lane, op, slots),
            _ => simd.run(
                #[inline(always)]
                || quick::<U, true>(lane, op, slots),
            ),
        };
        if !done {
            each(lane, simd, op, slots);
        }
        slots.commit(op.to);
    }
}

/// Computes a function of `N` rows in vector code, then `slow` in lanes where the vector result may be wrong.
#[inline(always)]
fn checked<const N: usize>(
    rows: [&LaneRow; N],
    out: &mut LaneRow,
    quick: impl Fn([u32; N]) -> (u32, Met),
    slow: impl Fn([u32; N]) -> u32,
) {
    let mut met = Met::NONE;
    for i in 0..LANES {
        let mut operands = [0; N];
        for k in 0..N {
            operands[k] = rows[k][i];
        }
        let (word, here) = quick(operands);
        out[i] = word;
        met = met.and(here);
    }
    if met.is_risky() {
        for i in 0..LANES {
            let operands = rows.map(|row| row[i]);
            if quick(operands).1.is_risky() {
                out[i] = slow(operands);
            }
        }
    }
}

/// Computes a sum of `N` products of `M` rows, the factors of one product after the other.
#[inline(always)]
fn products<U: CardUnit, const FUSED: bool, const N: usize, const M: usize>(
    unit: &U,
    rows: [&LaneRow; M],
    out: &mut LaneRow,
) {
    checked(
        rows,
        out,
        // Not inlined, a closure would be compiled for the baseline processor.
        #[inline(always)]
        |x| unit.quick_dot::<FUSED, N>(factors(x, 0), factors(x, 1)),
        |x| unit.dot::<N>(factors(x, 0), factors(x, 1)),
    );
}

/// The first or the second factors of products.
#[inline(always)]
fn factors<const N: usize, const M: usize>(x: [u32; M], which: usize) -> [u32; N] {
    let mut factors = [0; N];
    for k in 0..N {
        factors[k] = x[2 * k + which];
    }
    factors
}

#[inline(always)]
fn two(a: &LaneRow, b: &LaneRow, out: &mut LaneRow, f: impl Fn(u32, u32) -> u32) {
    for i in 0..LANES {
        out[i] = f(a[i], b[i]);
    }
}

/// Applies a function to a row and to table entries for it.
#[inline(always)]
fn with_table<E: Copy>(a: &LaneRow, out: &mut LaneRow, entry: impl Fn(u32) -> E, f: impl Fn(u32, E) -> u32) {
    let mut entries = [entry(0); LANES];
    for i in 0..LANES {
        entries[i] = entry(a[i]);
    }
    for i in 0..LANES {
        out[i] = f(a[i], entries[i]);
    }
}

#[inline(always)]
fn three([a, b, c]: [&LaneRow; 3], out: &mut LaneRow, f: impl Fn(u32, u32, u32) -> u32) {
    for i in 0..LANES {
        out[i] = f(a[i], b[i], c[i]);
    }
}

/// Computes an operation in vector code; returns `false` if there is no such code.
#[inline(always)]
fn quick<U: CardUnit, const FUSED: bool>(lane: &CardLane<U>, op: &LaneOp, slots: &mut Slots) -> bool {
    let Slots { rows, scratch, .. } = slots;
    let out: &mut LaneRow = scratch;
    let arg = |k: usize| -> &LaneRow { &rows[usize::from(op.args[k])] };
    let (a, b, c) = (arg(0), arg(1), arg(2));
    let unit = &lane.unit;
    match op.code {
        LaneCode::Plain(Op::Add) => checked([a, b], out, |[a, b]| unit.quick_add(a, b), |[a, b]| unit.add(a, b)),
        LaneCode::Plain(Op::Sub) => {
            checked([a, b], out, |[a, b]| unit.quick_add(a, b ^ SIGN), |[a, b]| unit.add(a, b ^ SIGN));
        }
        LaneCode::Plain(Op::Frc) => {
            let whole = |a: u32| unit.floor(a) ^ SIGN;
            checked([a], out, |[a]| unit.quick_add(a, whole(a)), |[a]| unit.add(a, whole(a)));
        }
        LaneCode::Plain(Op::Mul) => {
            checked([a, b], out, |[a, b]| unit.quick_mul::<FUSED>(a, b), |[a, b]| unit.mul(a, b))
        }
        LaneCode::Plain(Op::Mad | Op::FusedMad) => {
            checked([a, b, c], out, |[a, b, c]| unit.quick_mad::<FUSED>(a, b, c), |[a, b, c]| unit.mad(a, b, c));
        }
        LaneCode::Dot(2) => products::<U, FUSED, 2, 4>(unit, [a, b, c, arg(3)], out),
        LaneCode::Dot(3) => products::<U, FUSED, 3, 6>(unit, [a, b, c, arg(3), arg(4), arg(5)], out),
        LaneCode::Dot(4) => products::<U, FUSED, 4, 8>(unit, [a, b, c, arg(3), arg(4), arg(5), arg(6), arg(7)], out),
        LaneCode::Plain(Op::Min) => two(a, b, out, |a, b| unit.min(a, b)),
        LaneCode::Plain(Op::Max) => two(a, b, out, |a, b| unit.max(a, b)),
        LaneCode::Plain(Op::Neg) => two(a, a, out, |a, _| a ^ SIGN),
        LaneCode::Plain(Op::Abs) => two(a, a, out, |a, _| a & !SIGN),
        LaneCode::Plain(Op::Floor) => two(a, a, out, |a, _| unit.floor(a)),
        LaneCode::Plain(Op::Saturate) => two(a, a, out, |a, _| unit.saturate(a)),
        LaneCode::Plain(Op::Rcp) => with_table(a, out, |a| unit.rcp_entry(a), |a, entry| unit.rcp(a, entry)),
        LaneCode::Plain(Op::Rsq) => with_table(a, out, |a| unit.rsq_entry(a), |a, entry| unit.rsq(a, entry)),
        LaneCode::Plain(Op::Less) => two(a, b, out, |a, b| if lane.less(a, b) { TRUE } else { 0 }),
        LaneCode::Plain(Op::LessEqual) => two(a, b, out, |a, b| if lane.less_equal(a, b) { TRUE } else { 0 }),
        LaneCode::Plain(Op::Equal) => two(a, b, out, |a, b| if lane.equal(a, b) { TRUE } else { 0 }),
        LaneCode::Plain(Op::SetLess) => two(a, b, out, |a, b| lane.flag(a, b, lane.less(a, b))),
        LaneCode::Plain(Op::SetLessEqual) => two(a, b, out, |a, b| lane.flag(a, b, lane.less_equal(a, b))),
        LaneCode::Plain(Op::SelectNonNegative) => three([a, b, c], out, |a, b, c| lane.select_non_negative(a, b, c)),
        LaneCode::OrLess => three([a, b, c], out, |a, b, c| a | if lane.less(b, c) { TRUE } else { 0 }),
        _ => return false,
    }
    true
}

fn each<U: CardUnit>(lane: &CardLane<U>, simd: SimdLevel, op: &LaneOp, slots: &mut Slots) {
    let Slots { rows, scratch, wide, .. } = slots;
    let out: &mut LaneRow = scratch;
    let x = |k: usize, i: usize| rows[usize::from(op.args[k])][i];
    let (operation, immediate) = match op.code {
        LaneCode::Neighbors(down) => {
            let bit = if down { 16 } else { 1 };
            for (i, out) in out.iter_mut().enumerate() {
                *out = lane.unit.add(x(0, i | bit), x(0, i & !bit) ^ SIGN);
            }
            return;
        }
        LaneCode::Plain(Op::AddressFloor) => (Op::Floor, None),
        LaneCode::Plain(operation) => (operation, None),
        LaneCode::Immediate(operation, word) => (operation, Some(i32::from(word).cast_unsigned())),
        code => return apart(lane, simd, code, [0, 1, 2].map(|k| &*rows[usize::from(op.args[k])] as _), wide, out),
    };
    // Tests with one lane whether this is an operation on numbers.
    if lane.word(operation, [0; 3]).is_none() {
        let rows = [0, 1, 2].map(|k| -> &LaneRow { &rows[usize::from(op.args[k])] });
        return apart(lane, simd, op.code, rows, wide, out);
    }
    for (i, out) in out.iter_mut().enumerate() {
        let operands = [x(0, i), immediate.unwrap_or_else(|| x(1, i)), x(2, i)];
        *out = lane.word(operation, operands).unwrap_or_default();
    }
    if op.code == LaneCode::Plain(Op::AddressFloor) {
        pack::to_addresses(lane.reading(), out);
    }
}
