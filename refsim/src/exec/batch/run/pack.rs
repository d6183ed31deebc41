//! Packing of numbers into words, lane by lane.

use crate::exec::batch::lanes::{LANES, Lane, LaneRow, odd};

/// Inserts a part into the word of each lane.
#[inline(always)]
pub(crate) fn join<L: Lane>(
    words: &LaneRow,
    values: &LaneRow,
    out: &mut LaneRow,
    shift: i8,
    part: impl Fn(L::T) -> u32,
) {
    for i in 0..LANES {
        out[i] = words[i] | part(L::load(values[i])) << shift;
    }
}

/// Extracts a number from the word of each lane.
#[inline(always)]
pub(crate) fn split<L: Lane>(words: &LaneRow, out: &mut LaneRow, part: impl Fn(u32) -> L::T) {
    for i in 0..LANES {
        out[i] = L::store(part(words[i]));
    }
}

/// Clamps a single-precision number to [0, 1] and rounds it to an integer number of steps, halves up. The product is
/// exact, and so is the sum near an integer.
#[inline(always)]
pub(crate) fn unsigned(x: f64, steps: f64) -> u32 {
    let low = if x > 0.0 { x } else { 0.0 };
    let clamped = if low < 1.0 { low } else { 1.0 };
    (clamped * steps + 0.5).floor() as u32
}

/// Computes `128 + 127 x`, with x clamped to [-128/127, 1], rounded to nearest, halves up; 128 for NaN.
#[inline(always)]
pub(crate) fn signed(x: f64) -> u32 {
    let scaled = 127.0 * x;
    let low = if scaled > -128.0 { scaled } else { -128.0 };
    let clamped = if low < 127.0 { low } else { 127.0 };
    let rounded = (clamped + 0.5).floor();
    if x.is_nan() { 128 } else { (128.0 + rounded) as u32 }
}

/// `k / steps`, rounded to odd.
#[inline(always)]
pub(crate) fn fraction(k: u32, steps: f64) -> f64 {
    odd::div_odd_long(f64::from(k), steps)
}
