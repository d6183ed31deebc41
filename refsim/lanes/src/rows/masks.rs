//! Comparisons and operations on bits: identical in all formats, or in all formats of a kind.

use super::code::LaneCode;
use crate::lanes::{LANES, LaneRow, RegisterNumber, SimdLevel, TRUE};
use crate::num::NumberOperation as Op;

/// Comparisons: masks of `a < b`, `a <= b` and `a == b`, and the bitwise or of `a` and the mask of `b < c`; and a
/// selection: `b` if `0 <= a`, else `c`. Comparisons with NaN are false.
#[inline(never)]
pub(super) fn compare_numbers<T: RegisterNumber>(
    simd: SimdLevel,
    code: LaneCode,
    [a, b, c]: [&LaneRow; 3],
    out: &mut LaneRow,
) {
    simd.run(
        #[inline(always)]
        || match code {
            LaneCode::Plain(Op::Less) => compare::<T>(a, b, out, |a, b| a < b),
            LaneCode::Plain(Op::LessEqual) => compare::<T>(a, b, out, |a, b| a <= b),
            LaneCode::Plain(Op::Equal) => compare::<T>(a, b, out, |a, b| a == b),
            LaneCode::OrLess => or_less::<T>(a, b, c, out),
            _ => select_non_negative::<T>(a, b, c, out),
        },
    );
}

/// A selection by a mask, or an operation on bits.
#[inline(never)]
pub(super) fn combine_patterns(simd: SimdLevel, code: LaneCode, [a, b, c]: [&LaneRow; 3], out: &mut LaneRow) {
    simd.run(
        #[inline(always)]
        || match code {
            LaneCode::Plain(Op::And) => combine(a, b, out, |a, b| a & b),
            LaneCode::Plain(Op::Or) => combine(a, b, out, |a, b| a | b),
            LaneCode::Plain(Op::AndNot) => combine(a, b, out, |a, b| !a & b),
            _ => select(a, b, c, out),
        },
    );
}

#[inline(always)]
fn compare<T: RegisterNumber>(a: &LaneRow, b: &LaneRow, out: &mut LaneRow, f: impl Fn(T, T) -> bool) {
    for i in 0..LANES {
        out[i] = if f(T::from_bits(a[i]), T::from_bits(b[i])) { TRUE } else { 0 };
    }
}

#[inline(always)]
fn or_less<T: RegisterNumber>(mask: &LaneRow, a: &LaneRow, b: &LaneRow, out: &mut LaneRow) {
    for i in 0..LANES {
        out[i] = mask[i] | if T::from_bits(a[i]) < T::from_bits(b[i]) { TRUE } else { 0 };
    }
}

#[inline(always)]
fn select_non_negative<T: RegisterNumber>(a: &LaneRow, b: &LaneRow, c: &LaneRow, out: &mut LaneRow) {
    for i in 0..LANES {
        let mask = if T::from_bits(0) <= T::from_bits(a[i]) { TRUE } else { 0 };
        out[i] = mask & b[i] | !mask & c[i];
    }
}

#[inline(always)]
fn combine(a: &LaneRow, b: &LaneRow, out: &mut LaneRow, f: impl Fn(u32, u32) -> u32) {
    for i in 0..LANES {
        out[i] = f(a[i], b[i]);
    }
}

#[inline(always)]
fn select(mask: &LaneRow, a: &LaneRow, b: &LaneRow, out: &mut LaneRow) {
    for i in 0..LANES {
        // Masks are all zeros or all ones. The compiler would turn a conditional into a selection of addresses.
        out[i] = mask[i] & a[i] | !mask[i] & b[i];
    }
}
