//! Rows of the units of cards.
//!
//! Operations that matter for speed are computed in loops of vector code first. Where these mark a result that may be
//! wrong (a special value, an end of the range), the row is computed once more, lane by lane.

use super::apart::apart;
use super::code::{LaneCode, LaneOp};
use super::pack;
use super::slots::Slots;
use crate::lanes::{CardLane, CardUnit, LANES, Lane, LaneRow, SimdLevel, TRUE};
use crate::num::NumberOperation as Op;

/// The sign bit.
const SIGN: u32 = 1 << 31;

/// Executes operations in the arithmetic of a unit. Fused codes are not among them.
#[inline(never)]
pub(super) fn run<U: CardUnit>(lane: &CardLane<U>, simd: SimdLevel, ops: &[LaneOp], slots: &mut Slots) {
    for op in ops {
        if op.code == LaneCode::Widen {
            let Slots { rows, wide, .. } = slots;
            lane.reading().row_to_f64(simd, &rows[usize::from(op.args[0])], wide);
            continue;
        }
        let done = simd.run(
            #[inline(always)]
            || quick(lane, op, slots),
        );
        if !done {
            each(lane, simd, op, slots);
        }
        slots.commit(op.to);
    }
}

/// A function of `N` rows, which marks results that may be wrong; returns `true` if none is marked.
#[inline(always)]
fn marked<const N: usize>(rows: [&LaneRow; N], out: &mut LaneRow, f: impl Fn([u32; N]) -> (u32, u32)) -> bool {
    let mut marks = 0;
    for i in 0..LANES {
        let mut operands = [0; N];
        for k in 0..N {
            operands[k] = rows[k][i];
        }
        let (word, mark) = f(operands);
        out[i] = word;
        marks |= mark;
    }
    marks == 0
}

/// A function of two rows that is right.
#[inline(always)]
fn two(a: &LaneRow, b: &LaneRow, out: &mut LaneRow, f: impl Fn(u32, u32) -> u32) -> bool {
    for i in 0..LANES {
        out[i] = f(a[i], b[i]);
    }
    true
}

/// Computes an operation in vector code, if there is such code; returns `true` if all results are right.
#[inline(always)]
fn quick<U: CardUnit>(lane: &CardLane<U>, op: &LaneOp, slots: &mut Slots) -> bool {
    let Slots { rows, scratch, .. } = slots;
    let out: &mut LaneRow = scratch;
    let arg = |k: usize| -> &LaneRow { &rows[usize::from(op.args[k])] };
    let (a, b, c) = (arg(0), arg(1), arg(2));
    let unit = &lane.unit;
    match op.code {
        LaneCode::Plain(Op::Add) => marked([a, b], out, |[a, b]| unit.quick_add(a, b)),
        LaneCode::Plain(Op::Sub) => marked([a, b], out, |[a, b]| unit.quick_add(a, b ^ SIGN)),
        LaneCode::Plain(Op::Mul) => marked([a, b], out, |[a, b]| unit.quick_mul(a, b)),
        LaneCode::Plain(Op::Mad | Op::FusedMad) => marked([a, b, c], out, |[a, b, c]| unit.quick_mad(a, b, c)),
        LaneCode::Dot(2) => marked([a, b, c, arg(3)], out, |[a, b, c, d]| unit.quick_dot([a, c], [b, d])),
        LaneCode::Dot(3) => {
            marked([a, b, c, arg(3), arg(4), arg(5)], out, |[a, b, c, d, e, f]| unit.quick_dot([a, c, e], [b, d, f]))
        }
        LaneCode::Dot(4) => {
            marked([a, b, c, arg(3), arg(4), arg(5), arg(6), arg(7)], out, |[a, b, c, d, e, f, g, h]| {
                unit.quick_dot([a, c, e, g], [b, d, f, h])
            })
        }
        LaneCode::Plain(Op::Min) => two(a, b, out, |a, b| unit.min(a, b)),
        LaneCode::Plain(Op::Max) => two(a, b, out, |a, b| unit.max(a, b)),
        LaneCode::Plain(Op::Neg) => two(a, a, out, |a, _| a ^ SIGN),
        LaneCode::Plain(Op::Abs) => two(a, a, out, |a, _| a & !SIGN),
        LaneCode::Plain(Op::Less) => two(a, b, out, |a, b| if lane.less(a, b) { TRUE } else { 0 }),
        LaneCode::Plain(Op::LessEqual) => two(a, b, out, |a, b| if lane.less_equal(a, b) { TRUE } else { 0 }),
        LaneCode::Plain(Op::Equal) => two(a, b, out, |a, b| if lane.equal(a, b) { TRUE } else { 0 }),
        LaneCode::Plain(Op::SetLess) => two(a, b, out, |a, b| lane.flag(a, b, lane.less(a, b))),
        LaneCode::Plain(Op::SetLessEqual) => two(a, b, out, |a, b| lane.flag(a, b, lane.less_equal(a, b))),
        _ => false,
    }
}

/// Computes an operation lane by lane.
fn each<U: CardUnit>(lane: &CardLane<U>, simd: SimdLevel, op: &LaneOp, slots: &mut Slots) {
    let Slots { rows, scratch, wide, .. } = slots;
    let out: &mut LaneRow = scratch;
    let x = |k: usize, i: usize| rows[usize::from(op.args[k])][i];
    let (operation, immediate) = match op.code {
        LaneCode::Dot(terms) => {
            for (i, out) in out.iter_mut().enumerate() {
                *out = dot(lane, terms, |k| x(k, i));
            }
            return;
        }
        LaneCode::Neighbors(down) => {
            let bit = if down { 16 } else { 1 };
            for (i, out) in out.iter_mut().enumerate() {
                *out = lane.unit.add(x(0, i | bit), x(0, i & !bit) ^ SIGN);
            }
            return;
        }
        LaneCode::OrLess => {
            for (i, out) in out.iter_mut().enumerate() {
                *out = x(0, i) | if lane.less(x(1, i), x(2, i)) { TRUE } else { 0 };
            }
            return;
        }
        LaneCode::Plain(Op::AddressFloor) => (Op::Floor, None),
        LaneCode::Plain(operation) => (operation, None),
        LaneCode::Immediate(operation, word) => (operation, Some(i32::from(word).cast_unsigned())),
        code => return apart(lane, simd, code, [0, 1, 2].map(|k| &*rows[usize::from(op.args[k])] as _), wide, out),
    };
    // The first lane tells whether it is an operation on numbers.
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

/// The dot product of a lane whose operands `x` has, the factors of one product after the other.
fn dot<U: CardUnit>(lane: &CardLane<U>, terms: u8, x: impl Fn(usize) -> u32) -> u32 {
    match terms {
        2 => lane.unit.dot([x(0), x(2)], [x(1), x(3)]),
        3 => lane.unit.dot([x(0), x(2), x(4)], [x(1), x(3), x(5)]),
        _ => lane.unit.dot([x(0), x(2), x(4), x(6)], [x(1), x(3), x(5), x(7)]),
    }
}
