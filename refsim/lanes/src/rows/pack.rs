//! Packing of numbers into words, and conversion to addresses, lane by lane: rarely used, so not vectorized.

use super::code::LaneCode;
use crate::lanes::{LANES, LaneRow, Reading, div_odd_long};
use crate::num::NumberOperation as Op;

/// Inserts a number into the word of each lane, for [`Op::JoinShort`], [`Op::JoinByte`] or [`Op::JoinSignedByte`].
pub(super) fn join(reading: Reading, code: LaneCode, [words, values]: [&LaneRow; 2], out: &mut LaneRow) {
    let LaneCode::Immediate(operation, shift) = code else { return };
    for i in 0..LANES {
        let x = reading.to_f64(values[i]);
        let part = match operation {
            Op::JoinShort => unsigned(x, 65535.0),
            Op::JoinByte => unsigned(x, 255.0),
            _ => signed(x),
        };
        out[i] = words[i] | part << shift;
    }
}

/// Inserts the low halves of bit patterns into the word of each lane.
pub(super) fn join_patterns(words: &LaneRow, shift: i8, patterns: &mut LaneRow) {
    for i in 0..LANES {
        patterns[i] = words[i] | (patterns[i] & 0xffff) << shift;
    }
}

/// The numbers to be rounded: the extracted part of each lane's word, rounded to odd, or each number's nearest integer.
/// `None` for other operations.
pub(super) fn parts(reading: Reading, code: LaneCode, row: &LaneRow) -> Option<Box<[f64; LANES]>> {
    let (operation, shift) = match code {
        LaneCode::Immediate(operation, shift) => (operation, shift),
        LaneCode::Plain(operation) => (operation, 0),
        _ => return None,
    };
    let part = |raw: u32| match operation {
        Op::SplitShort => fraction(raw >> shift & 0xffff, 65535.0),
        Op::SplitByte => fraction(raw >> shift & 0xff, 255.0),
        Op::SplitSignedByte => {
            let k = raw >> shift & 0xff;
            let magnitude = fraction(k.abs_diff(128), 127.0);
            if k < 128 { -magnitude } else { magnitude }
        }
        _ => reading.to_f64(raw).round_ties_even(),
    };
    Some(Box::new(row.map(part)))
}

/// Converts the integers of a row to addresses; NaN gives 0.
pub(super) fn to_addresses(reading: Reading, row: &mut LaneRow) {
    for raw in row {
        *raw = (reading.to_f64(*raw).trunc() as i32).cast_unsigned();
    }
}

/// Clamps a single-precision number to [0, 1] and rounds it to an integer number of steps, halves up. The product is
/// exact, and so is the sum near an integer.
fn unsigned(x: f64, steps: f64) -> u32 {
    let low = if x > 0.0 { x } else { 0.0 };
    let clamped = if low < 1.0 { low } else { 1.0 };
    (clamped * steps + 0.5).floor() as u32
}

/// Computes `128 + 127 x`, with x clamped to [-128/127, 1], rounded to nearest, halves up; 128 for NaN.
fn signed(x: f64) -> u32 {
    let scaled = 127.0 * x;
    let low = if scaled > -128.0 { scaled } else { -128.0 };
    let clamped = if low < 127.0 { low } else { 127.0 };
    let rounded = (clamped + 0.5).floor();
    if x.is_nan() { 128 } else { (128.0 + rounded) as u32 }
}

/// `k / steps`, rounded to odd.
fn fraction(k: u32, steps: f64) -> f64 {
    div_odd_long(f64::from(k), steps)
}
