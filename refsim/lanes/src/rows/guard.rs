//! Recomputation of infinite and NaN results, which a fast arithmetic may get wrong.
//!
//! Fast arithmetics omit checks for the end of the range, and for products of zero and infinity. Any such error, even
//! in an intermediate result of a longer operation, leads to an infinity or a NaN, so only these results are recomputed
//! with the general arithmetic.

use super::code::{LaneCode, LaneOp};
use super::slots::Slots;
use crate::lanes::{LANES, Lane, apply, is_finite};
use crate::num::NumberOperation as Op;

/// Recomputes the non-finite results in the scratch row.
pub(crate) fn mend<L: Lane>(lane: Option<L>, op: &LaneOp, slots: &mut Slots) {
    let Some(lane) = lane else { return };
    let Slots { rows, scratch, values, .. } = slots;
    for i in 0..LANES {
        if is_finite(scratch[i]) {
            continue;
        }
        let operand = |k: usize, i: usize| {
            let slot = usize::from(op.args[k]);
            L::load(if op.code.is_shared(k) { values[slot] } else { rows[slot][i] })
        };
        let value = match op.code {
            LaneCode::Neighbors(down) => {
                let partner = if down { 16 } else { 1 };
                Some(lane.sub(operand(0, i | partner), operand(0, i & !partner)))
            }
            _ => value(&lane, op, |k| operand(k, i)),
        };
        if let Some(value) = value {
            scratch[i] = L::store(value);
        }
    }
}

/// Computes the result of one lane; `None` for operations that need no recomputation.
fn value<L: Lane>(lane: &L, op: &LaneOp, x: impl Fn(usize) -> L::T) -> Option<L::T> {
    let factors = |k: usize| match (x(2 * k), x(2 * k + 1)) {
        (a, b) if op.zero_wins => (lane.factor(a, b), lane.factor(b, a)),
        pair => pair,
    };
    let product = |k: usize| {
        let (a, b) = factors(k);
        lane.mul(a, b)
    };
    Some(match op.code {
        LaneCode::Plain(Op::Mul) => product(0),
        LaneCode::Plain(Op::Mad) | LaneCode::MadBy => lane.add(product(0), x(2)),
        LaneCode::Plain(Op::FusedMad) => {
            let (a, b) = factors(0);
            lane.fused_mad(a, b, x(2))
        }
        LaneCode::Plain(operation) => return apply(lane, operation, [x(0), x(1), x(2)]),
        LaneCode::AddTo => lane.add(x(0), x(1)),
        LaneCode::SubFrom => lane.sub(x(0), x(1)),
        LaneCode::SubOff => lane.sub(x(1), x(0)),
        LaneCode::Sum(terms) | LaneCode::SumBy(terms) => {
            (1..usize::from(terms)).fold(product(0), |sum, k| lane.add(sum, product(k)))
        }
        LaneCode::Difference => lane.add(product(0), lane.neg(product(1))),
        LaneCode::Dot(terms) => {
            let (mut a, mut b) = ([L::T::default(); 4], [L::T::default(); 4]);
            for k in 0..usize::from(terms) {
                (a[k], b[k]) = factors(k);
            }
            match terms {
                2 => lane.exact_dot([a[0], a[1]], [b[0], b[1]]),
                3 => lane.exact_dot([a[0], a[1], a[2]], [b[0], b[1], b[2]]),
                _ => lane.exact_dot(a, b),
            }
        }
        _ => return None,
    })
}
