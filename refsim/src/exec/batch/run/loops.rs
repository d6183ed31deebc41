//! Loops over rows: apply a function of lane values to all lanes.
//!
//! Each row is a separate argument, so that the compiler knows that the result does not alias the operands. Behind a
//! box or in a slice of rows it can't tell, and doesn't vectorise.

use super::slots::Slots;
use crate::exec::batch::lanes::{LANES, Lane, LaneRow, is_finite};
use crate::exec::batch::schedule::LaneOp;
use crate::exec::lower::TRUE;

/// Applies a function of pairs of rows.
#[inline(always)]
pub(crate) fn dot<L: Lane, const N: usize>(op: &LaneOp, slots: &mut Slots, f: impl Fn([L::T; N], [L::T; N]) -> L::T) {
    let Slots { rows, scratch, .. } = slots;
    let a: [&LaneRow; N] = std::array::from_fn(|k| &**rows[usize::from(op.args[2 * k])]);
    let b: [&LaneRow; N] = std::array::from_fn(|k| &**rows[usize::from(op.args[2 * k + 1])]);
    pairs::<L, N>(a, b, scratch, f);
}

#[inline(always)]
pub(crate) fn pairs<L: Lane, const N: usize>(
    a: [&LaneRow; N],
    b: [&LaneRow; N],
    out: &mut LaneRow,
    f: impl Fn([L::T; N], [L::T; N]) -> L::T,
) {
    for i in 0..LANES {
        let (mut x, mut y) = ([L::load(0); N], [L::load(0); N]);
        for k in 0..N {
            (x[k], y[k]) = (L::load(a[k][i]), L::load(b[k][i]));
        }
        out[i] = L::store(f(x, y));
    }
}

/// Applies a function of pairs of a uniform value and a row.
#[inline(always)]
pub(crate) fn dot_by<L: Lane, const N: usize>(
    op: &LaneOp,
    slots: &mut Slots,
    f: impl Fn([L::T; N], [L::T; N]) -> L::T,
) {
    let Slots { rows, scratch, values, .. } = slots;
    let a: [L::T; N] = std::array::from_fn(|k| L::load(values[usize::from(op.args[2 * k])]));
    let b: [&LaneRow; N] = std::array::from_fn(|k| &**rows[usize::from(op.args[2 * k + 1])]);
    pairs_by::<L, N>(a, b, scratch, f);
}

#[inline(always)]
pub(crate) fn pairs_by<L: Lane, const N: usize>(
    a: [L::T; N],
    b: [&LaneRow; N],
    out: &mut LaneRow,
    f: impl Fn([L::T; N], [L::T; N]) -> L::T,
) {
    for i in 0..LANES {
        let mut y = [L::load(0); N];
        for k in 0..N {
            y[k] = L::load(b[k][i]);
        }
        out[i] = L::store(f(a, y));
    }
}

#[inline(always)]
pub(crate) fn one<L: Lane>(a: &LaneRow, out: &mut LaneRow, f: impl Fn(L::T) -> L::T) {
    for i in 0..LANES {
        out[i] = L::store(f(L::load(a[i])));
    }
}

#[inline(always)]
pub(crate) fn two<L: Lane>(a: &LaneRow, b: &LaneRow, out: &mut LaneRow, f: impl Fn(L::T, L::T) -> L::T) {
    for i in 0..LANES {
        out[i] = L::store(f(L::load(a[i]), L::load(b[i])));
    }
}

#[inline(always)]
pub(crate) fn three<L: Lane>(
    a: &LaneRow,
    b: &LaneRow,
    c: &LaneRow,
    out: &mut LaneRow,
    f: impl Fn(L::T, L::T, L::T) -> L::T,
) {
    for i in 0..LANES {
        out[i] = L::store(f(L::load(a[i]), L::load(b[i]), L::load(c[i])));
    }
}

#[inline(always)]
pub(crate) fn compare<L: Lane>(a: &LaneRow, b: &LaneRow, out: &mut LaneRow, f: impl Fn(L::T, L::T) -> bool) {
    for i in 0..LANES {
        out[i] = if f(L::load(a[i]), L::load(b[i])) { TRUE } else { 0 };
    }
}

#[inline(always)]
pub(crate) fn or_less<L: Lane>(lane: &L, mask: &LaneRow, a: &LaneRow, b: &LaneRow, out: &mut LaneRow) {
    for i in 0..LANES {
        out[i] = mask[i] | if lane.lt(L::load(a[i]), L::load(b[i])) { TRUE } else { 0 };
    }
}

#[inline(always)]
pub(crate) fn bitwise(a: &LaneRow, b: &LaneRow, out: &mut LaneRow, f: impl Fn(u32, u32) -> u32) {
    for i in 0..LANES {
        out[i] = f(a[i], b[i]);
    }
}

#[inline(always)]
pub(crate) fn select(mask: &LaneRow, a: &LaneRow, b: &LaneRow, out: &mut LaneRow) {
    for i in 0..LANES {
        // Masks are all zeros or all ones; a conditional would become a selection of addresses.
        out[i] = mask[i] & a[i] | !mask[i] & b[i];
    }
}

#[inline(always)]
pub(crate) fn widen<L: Lane>(lane: &L, a: &LaneRow, out: &mut [f64; LANES]) {
    for i in 0..LANES {
        out[i] = lane.to_f64(L::load(a[i]));
    }
}

#[inline(always)]
pub(crate) fn narrow<L: Lane>(lane: &L, a: &[f64; LANES], out: &mut LaneRow) {
    for i in 0..LANES {
        out[i] = L::store(lane.round_f64(a[i]));
    }
}

/// Returns `true` if no float of a row is infinite or NaN.
#[inline(always)]
pub(crate) fn all_finite(row: &LaneRow) -> bool {
    let mut largest = 0;
    for &raw in row {
        largest = largest.max(raw & 0x7fff_ffff);
    }
    is_finite(largest)
}

/// Differences between lane pairs whose indices differ in `bit`: higher minus lower.
#[inline(always)]
pub(crate) fn difference<L: Lane>(lane: &L, a: &LaneRow, out: &mut LaneRow, bit: usize) {
    for i in 0..LANES {
        out[i] = L::store(lane.sub(L::load(a[i | bit]), L::load(a[i & !bit])));
    }
}

/// Converts an integer in a double to an address; NaN gives 0.
pub(crate) fn address(x: f64) -> u32 {
    (x as i32).cast_unsigned()
}
