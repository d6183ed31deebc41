//! Loops over rows: apply a function of lane values to all lanes.
//!
//! Each row is a separate argument, so that the compiler knows that the result does not alias the operands. It does not
//! know the length of boxed rows or slices, and does not vectorise them.
//!
//! Loops that write rows also return the largest magnitude of their results, which guarded arithmetics need: this costs
//! almost nothing, and nothing if it is not used.

use super::code::LaneOp;
use super::slots::Slots;
use crate::lanes::{LANES, Lane, LaneRow};

/// Largest host bits, without the sign bit, of the results of a loop. For floats it shows whether all are finite.
pub(crate) type Largest = u32;

/// Stores a result and updates the largest magnitude.
#[inline(always)]
fn put<L: Lane>(out: &mut u32, largest: &mut Largest, value: L::T) {
    *out = L::store(value);
    *largest = (*largest).max(*out & 0x7fff_ffff);
}

/// Applies a function of pairs of rows.
#[inline(always)]
pub(crate) fn dot<L: Lane, const N: usize>(
    op: &LaneOp,
    slots: &mut Slots,
    f: impl Fn([L::T; N], [L::T; N]) -> L::T,
) -> Largest {
    let Slots { rows, scratch, .. } = slots;
    let a: [&LaneRow; N] = std::array::from_fn(|k| &**rows[usize::from(op.args[2 * k])]);
    let b: [&LaneRow; N] = std::array::from_fn(|k| &**rows[usize::from(op.args[2 * k + 1])]);
    pairs::<L, N>(a, b, scratch, f)
}

#[inline(always)]
pub(crate) fn pairs<L: Lane, const N: usize>(
    a: [&LaneRow; N],
    b: [&LaneRow; N],
    out: &mut LaneRow,
    f: impl Fn([L::T; N], [L::T; N]) -> L::T,
) -> Largest {
    let mut largest = 0;
    for i in 0..LANES {
        let (mut x, mut y) = ([L::load(0); N], [L::load(0); N]);
        for k in 0..N {
            (x[k], y[k]) = (L::load(a[k][i]), L::load(b[k][i]));
        }
        put::<L>(&mut out[i], &mut largest, f(x, y));
    }
    largest
}

/// Applies a function of pairs of a uniform value and a row.
#[inline(always)]
pub(crate) fn dot_by<L: Lane, const N: usize>(
    op: &LaneOp,
    slots: &mut Slots,
    f: impl Fn([L::T; N], [L::T; N]) -> L::T,
) -> Largest {
    let Slots { rows, scratch, values, .. } = slots;
    let a: [L::T; N] = std::array::from_fn(|k| L::load(values[usize::from(op.args[2 * k])]));
    let b: [&LaneRow; N] = std::array::from_fn(|k| &**rows[usize::from(op.args[2 * k + 1])]);
    pairs_by::<L, N>(a, b, scratch, f)
}

#[inline(always)]
pub(crate) fn pairs_by<L: Lane, const N: usize>(
    a: [L::T; N],
    b: [&LaneRow; N],
    out: &mut LaneRow,
    f: impl Fn([L::T; N], [L::T; N]) -> L::T,
) -> Largest {
    let mut largest = 0;
    for i in 0..LANES {
        let mut y = [L::load(0); N];
        for k in 0..N {
            y[k] = L::load(b[k][i]);
        }
        put::<L>(&mut out[i], &mut largest, f(a, y));
    }
    largest
}

#[inline(always)]
pub(crate) fn one<L: Lane>(a: &LaneRow, out: &mut LaneRow, f: impl Fn(L::T) -> L::T) -> Largest {
    let mut largest = 0;
    for i in 0..LANES {
        put::<L>(&mut out[i], &mut largest, f(L::load(a[i])));
    }
    largest
}

#[inline(always)]
pub(crate) fn two<L: Lane>(a: &LaneRow, b: &LaneRow, out: &mut LaneRow, f: impl Fn(L::T, L::T) -> L::T) -> Largest {
    let mut largest = 0;
    for i in 0..LANES {
        put::<L>(&mut out[i], &mut largest, f(L::load(a[i]), L::load(b[i])));
    }
    largest
}

#[inline(always)]
pub(crate) fn three<L: Lane>(
    a: &LaneRow,
    b: &LaneRow,
    c: &LaneRow,
    out: &mut LaneRow,
    f: impl Fn(L::T, L::T, L::T) -> L::T,
) -> Largest {
    let mut largest = 0;
    for i in 0..LANES {
        put::<L>(&mut out[i], &mut largest, f(L::load(a[i]), L::load(b[i]), L::load(c[i])));
    }
    largest
}

/// Returns the [`Largest`] of a row.
#[inline(always)]
pub(crate) fn largest_of(row: &LaneRow) -> Largest {
    row.iter().fold(0, |largest, raw| largest.max(raw & 0x7fff_ffff))
}

/// Differences between lane pairs whose indices differ in `bit`: higher minus lower.
#[inline(always)]
pub(crate) fn difference<L: Lane>(lane: &L, a: &LaneRow, out: &mut LaneRow, bit: usize) -> Largest {
    let mut largest = 0;
    for i in 0..LANES {
        let value = lane.sub(L::load(a[i | bit]), L::load(a[i & !bit]));
        put::<L>(&mut out[i], &mut largest, value);
    }
    largest
}
