//! Evaluates one operation on many operands, with the lane arithmetic in which programs run.

use super::any::{AnyLane, Arithmetic, with_any_lane};
use super::lane::{Lane, apply, is_finite};
use super::unit::{CardLane, CardUnit, drops_small_halves, without_small};
use crate::num::{Format, NumberOperation};

/// Evaluates the operation on arrays of bit patterns of `format`; missing operands count as zero. Comparisons return
/// the integers 1 and 0, other operations bit patterns. Returns `None` if the lane arithmetic does not have the
/// operation.
///
/// This is the batch executor's arithmetic, written independently of [`crate::num::ops`]; tests compare the two.
pub fn evaluate(format: Format, operation: NumberOperation, [a, b, c]: [&[u32]; 3]) -> Option<Vec<u32>> {
    match AnyLane::new(format).arithmetic() {
        Arithmetic::Nv(lane) => return words(lane, operation, [a, b, c]),
        Arithmetic::Gt200(lane) => return words(lane, operation, [a, b, c]),
        _ => {}
    }
    with_any_lane!(&AnyLane::new(format), |lane| {
        a.iter().enumerate().map(|(i, &a)| evaluated(lane, operation, [a, bits_at(b, i), bits_at(c, i)])).collect()
    })
}

/// [`evaluate`] in the arithmetic of a card's unit, on words.
fn words<U: CardUnit>(lane: &CardLane<U>, operation: NumberOperation, [a, b, c]: [&[u32]; 3]) -> Option<Vec<u32>> {
    use NumberOperation::{Equal, Less, LessEqual};
    let compares = matches!(operation, Less | LessEqual | Equal);
    let word = |i: usize, a: u32| lane.word(operation, [a, bits_at(b, i), bits_at(c, i)]);
    a.iter().enumerate().map(|(i, &a)| word(i, a).map(|word| if compares { word & 1 } else { word })).collect()
}

/// Computes `a b + b c + c a`, plus `b b` for four terms, rounded once.
pub fn exact_dot(format: Format, terms: usize, [a, b, c]: [&[u32]; 3]) -> Vec<u32> {
    fn dot<L: Lane>(lane: &L, terms: usize, operands: [u32; 3]) -> u32 {
        let [a, b, c] = operands.map(|bits| lane.decode(bits));
        lane.encode(match terms {
            4 => lane.exact_dot([a, b, c, b], [b, c, a, b]),
            _ => lane.exact_dot([a, b, c], [b, c, a]),
        })
    }
    with_any_lane!(&AnyLane::new(format), |lane| {
        a.iter().enumerate().map(|(i, &a)| dot(lane, terms, [a, bits_at(b, i), bits_at(c, i)])).collect()
    })
}

fn bits_at(row: &[u32], i: usize) -> u32 {
    row.get(i).copied().unwrap_or_default()
}

/// [`evaluate`] for one lane.
fn evaluated<L: Lane>(lane: &L, operation: NumberOperation, operands: [u32; 3]) -> Option<u32> {
    if L::CARD {
        return None;
    }
    use NumberOperation as Op;
    let [a, b, c] = operands.map(|bits| lane.decode(bits));
    let value = match operation {
        Op::Scale => lane.scale(a, operands[1].cast_signed()),
        Op::SelectNonNegative if lane.decode(0) <= a => b,
        Op::SelectNonNegative => c,
        Op::SelectAboveHalf if lane.above_half(a) => b,
        Op::SelectAboveHalf => c,
        Op::Less => return Some((a < b).into()),
        Op::LessEqual => return Some((a <= b).into()),
        Op::Equal => return Some((a == b).into()),
        _ => apply(lane, operation, [a, b, c])?,
    };
    let raw = match lane.general() {
        Some(general) if lane.is_guarded() && !is_finite(L::store(value)) => {
            apply(&general, operation, [a, b, c].map(|x| L::General::load(L::store(x)))).map(L::General::store)
        }
        _ => None,
    };
    Some(lane.encode(raw.map_or(value, L::load)))
}

/// Converts bit patterns of `from` to `to`, as [`crate::num::ops::convert`] defines it.
pub fn convert(from: Format, to: Format, bits: &[u32]) -> Vec<u32> {
    let mut wide = Vec::with_capacity(bits.len());
    with_any_lane!(&AnyLane::new(from), |lane| { wide.extend(bits.iter().map(|&b| lane.to_f64(lane.decode(b)))) });
    if drops_small_halves(&from, &to) {
        wide.iter_mut().for_each(|x| *x = without_small(*x));
    }
    let mut out = Vec::with_capacity(bits.len());
    with_any_lane!(&AnyLane::new(to), |lane| { out.extend(wide.iter().map(|&x| lane.encode(lane.round_f64(x)))) });
    out
}
