//! One operation on many operands, through the same lanes that programs run in.

use super::any::{AnyLane, with_any_lane};
use super::lane::{LANES, Lane};
use crate::num::Format;

/// An operation of the lane arithmetic, as [`evaluate`] takes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "named as in refsim::num::ops, which defines them")]
pub enum LaneOperation {
    Add,
    Sub,
    Mul,
    /// Product and sum rounded one after the other.
    Mad,
    FusedMad,
    /// `a b + b c + c a`, rounded once.
    ExactDot3,
    /// `a b + b c + c a + b b`, rounded once.
    ExactDot4,
    Div,
    Sqrt,
    Rcp,
    Rsq,
    Exp2,
    Log2,
    Min,
    Max,
    Floor,
    Frc,
    Neg,
    Abs,
    /// Times two to this power.
    Scale(i8),
    Saturate,
    /// 1 where `a < b`.
    Lt,
    /// 1 where `a <= b`.
    Le,
    /// 1 where `a == b`.
    Eq,
    /// `a >= 0 ? b : c`
    Cmp,
    /// `a > 1/2 ? b : c`
    Cnd,
}

/// The operation on operands given as bit patterns of `format`; missing operands count as zero. Comparisons give the
/// plain numbers 1 and 0, everything else bit patterns of `format`.
///
/// This is the batch executor's arithmetic, written apart from [`crate::num::ops`] and equal to it; the full proof
/// compares the two through this function.
pub fn evaluate(format: Format, operation: LaneOperation, a: &[u32], b: &[u32], c: &[u32]) -> Vec<u32> {
    let mut out = Vec::with_capacity(a.len());
    with_any_lane!(&AnyLane::new(format), |lane| {
        for start in (0..a.len()).step_by(LANES) {
            let end = a.len().min(start + LANES);
            let part = |s: &[u32]| {
                let mut values = [lane.decode(0); LANES];
                for (value, &bits) in values.iter_mut().zip(s.get(start..end.min(s.len())).unwrap_or_default()) {
                    *value = lane.decode(bits);
                }
                values
            };
            let results = apply(lane, operation, &part(a), &part(b), &part(c));
            out.extend_from_slice(&results[..end - start]);
        }
    });
    out
}

fn apply<L: Lane>(lane: &L, operation: LaneOperation, a: &[L::T], b: &[L::T], c: &[L::T]) -> [u32; LANES] {
    use LaneOperation as Op;
    let zero = lane.decode(0);
    std::array::from_fn(|i| {
        let (a, b, c) = (a[i], b[i], c[i]);
        let value = match operation {
            Op::Add => lane.add(a, b),
            Op::Sub => lane.sub(a, b),
            Op::Mul => lane.mul(a, b),
            Op::Mad => lane.add(lane.mul(a, b), c),
            Op::FusedMad => lane.fused_mad(a, b, c),
            Op::ExactDot3 => lane.exact_dot([a, b, c], [b, c, a]),
            Op::ExactDot4 => lane.exact_dot([a, b, c, b], [b, c, a, b]),
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
            Op::Scale(shift) => lane.scale(a, i32::from(shift)),
            Op::Saturate => lane.saturate(a),
            Op::Cmp => {
                if lane.le(zero, a) {
                    b
                } else {
                    c
                }
            }
            Op::Cnd => {
                if lane.above_half(a) {
                    b
                } else {
                    c
                }
            }
            Op::Lt => return u32::from(lane.lt(a, b)),
            Op::Le => return u32::from(lane.le(a, b)),
            Op::Eq => return u32::from(lane.eq(a, b)),
        };
        lane.encode(value)
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
