//! One operation on many operands, through the same lanes that programs run in.

use super::any::{AnyLane, Arithmetic, with_any_lane};
use super::lane::Lane;
use super::unit::{CardLane, CardUnit};
use crate::num::{Format, NumberOperation};

/// The operation on operands given as bit patterns of `format`; missing operands count as zero. Comparisons give the
/// plain numbers 1 and 0, everything else bit patterns of `format`. `None` for operations that the lane arithmetic does
/// not have.
///
/// This is the batch executor's arithmetic, written apart from [`crate::num::ops`] and equal to it; the full proof
/// compares the two through this function.
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

/// The operation of a card's unit, on words.
fn words<U: CardUnit>(lane: &CardLane<U>, operation: NumberOperation, [a, b, c]: [&[u32]; 3]) -> Option<Vec<u32>> {
    use NumberOperation::{Equal, Less, LessEqual};
    let compares = matches!(operation, Less | LessEqual | Equal);
    let word = |i: usize, a: u32| lane.word(operation, [a, bits_at(b, i), bits_at(c, i)]);
    a.iter().enumerate().map(|(i, &a)| word(i, a).map(|word| if compares { word & 1 } else { word })).collect()
}

/// `a b + b c + c a`, and for four terms `+ b b`, rounded once.
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

/// The operation on bit patterns.
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

/// Returns `true` if the float in a slot is neither infinite nor NaN.
#[inline(always)]
pub(crate) fn is_finite(raw: u32) -> bool {
    raw & 0x7fff_ffff < 0x7f80_0000
}

/// The operations that compute a number from numbers.
pub(crate) fn apply<L: Lane>(lane: &L, operation: NumberOperation, [a, b, c]: [L::T; 3]) -> Option<L::T> {
    use NumberOperation as Op;
    Some(match operation {
        Op::Add => lane.add(a, b),
        Op::Sub => lane.sub(a, b),
        Op::Mul => lane.mul(a, b),
        Op::Mad => lane.add(lane.mul(a, b), c),
        Op::FusedMad => lane.fused_mad(a, b, c),
        Op::Div => lane.div(a, b),
        Op::Sqrt => lane.sqrt(a),
        Op::Rcp => lane.rcp(a),
        Op::Rsq => lane.rsq(a),
        Op::Exp2 => lane.exp2(a),
        Op::Log2 => lane.log2(a),
        Op::Min => lane.min(a, b),
        Op::Max => lane.max(a, b),
        Op::Floor => lane.floor(a),
        Op::Frc => lane.frc(a),
        Op::Neg => lane.neg(a),
        Op::Abs => lane.abs(a),
        Op::Saturate => lane.saturate(a),
        _ => return None,
    })
}

/// Bit patterns of `from` converted to `to`, as [`crate::num::ops::convert`] defines it.
pub fn convert(from: Format, to: Format, bits: &[u32]) -> Vec<u32> {
    let mut wide = Vec::with_capacity(bits.len());
    with_any_lane!(&AnyLane::new(from), |lane| { wide.extend(bits.iter().map(|&b| lane.to_f64(lane.decode(b)))) });
    let mut out = Vec::with_capacity(bits.len());
    with_any_lane!(&AnyLane::new(to), |lane| { out.extend(wide.iter().map(|&x| lane.encode(lane.round_f64(x)))) });
    out
}
