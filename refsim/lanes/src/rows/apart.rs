//! Operations that are compiled once for all formats, or once per kind of numbers.

use super::code::LaneCode;
use super::masks::{combine_patterns, compare_numbers};
use super::pack;
use crate::lanes::{LANES, Lane, LaneRow, SimdLevel, narrow};
use crate::num::NumberOperation as Op;

/// Computes an operation whose results are not numbers of the format, or are never guarded. Only rounding, decoding and
/// encoding are compiled per format.
#[inline(always)]
pub(super) fn apart<L: Lane>(
    l: &L,
    simd: SimdLevel,
    code: LaneCode,
    [a, b, c]: [&LaneRow; 3],
    wide: &[f64; LANES],
    out: &mut LaneRow,
) {
    match code {
        LaneCode::Plain(Op::Less | Op::LessEqual | Op::Equal | Op::SelectNonNegative) | LaneCode::OrLess => {
            compare_numbers::<L::T>(simd, code, [a, b, c], out);
        }
        LaneCode::Plain(Op::Select | Op::And | Op::Or | Op::AndNot) => {
            combine_patterns(simd, code, [a, b, c], out);
        }
        LaneCode::Narrow
        | LaneCode::Plain(Op::AddressNearest)
        | LaneCode::Immediate(Op::SplitShort | Op::SplitByte | Op::SplitSignedByte, _) => {
            let parts = pack::parts(l.reading(), code, a);
            narrow(l, parts.as_deref().unwrap_or(wide), out);
            if code == LaneCode::Plain(Op::AddressNearest) {
                pack::to_addresses(l.reading(), out);
            }
        }
        LaneCode::Immediate(Op::JoinShort | Op::JoinByte | Op::JoinSignedByte, _) => {
            pack::join(l.reading(), code, [a, b], out);
        }
        LaneCode::Plain(Op::Encode) | LaneCode::Immediate(Op::JoinPattern, _) => {
            let numbers = if code == LaneCode::Plain(Op::Encode) { a } else { b };
            for i in 0..LANES {
                out[i] = l.encode(L::load(numbers[i]));
            }
            if let LaneCode::Immediate(_, shift) = code {
                pack::join_patterns(a, shift, out);
            }
        }
        LaneCode::Plain(Op::Decode) | LaneCode::Immediate(Op::SplitPattern, _) => {
            let (shift, mask) = match code {
                LaneCode::Immediate(_, shift) => (shift, 0xffff),
                _ => (0, u32::MAX),
            };
            for i in 0..LANES {
                out[i] = L::store(l.decode(a[i] >> shift & mask));
            }
        }
        // The caller or separate steps execute these.
        _ => {}
    }
}
