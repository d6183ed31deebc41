//! Branch-free roundings to integers, selected by constants: of integers divided by powers of two, of doubles, and of
//! quotients.

use super::round::{AWAY, EVEN, UP, ZERO};

/// Division by a power of two, by one formula for every rounding: `(v + more + (v >> at & mask)) >> count`.
///
/// - Nearest even is `floor((v + half - 1 + odd) / 2^count)`: ties move up only from odd floors.
/// - Nearest away adds half a unit, less one where `v` is negative.
/// - Rounding toward zero rounds up where `v` is negative; rounding up does so everywhere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shift {
    pub(super) count: u32,
    /// Half a unit, and the mask of the dropped bits; zero if no bits are dropped.
    pub(super) half: i64,
    pub(super) dropped: i64,
    pub(super) more: i64,
    pub(super) mask: i64,
    /// `true` if the mask applies to the sign of `v`, not to its lowest remaining bit.
    pub(super) by_sign: bool,
}

impl Shift {
    #[inline(always)]
    pub(super) const fn new(rounding: u8, count: u32) -> Shift {
        let dropped = 1_i64.wrapping_shl(count).wrapping_sub(1);
        let (half, some) = (dropped.wrapping_add(1) >> 1 & dropped, 1 & dropped);
        let (more, mask) = match rounding {
            EVEN => (half.wrapping_sub(some), some),
            AWAY => (half, some.wrapping_neg()),
            ZERO => (0, dropped),
            UP => (dropped, 0),
            _ => (0, 0),
        };
        Shift { count, half, dropped, more, mask, by_sign: rounding != EVEN }
    }
}

/// Adding this to a double leaves the nearest integer, ties to even, in the low bits of the sum.
pub(super) const PIVOT: f64 = 6_755_399_441_055_744.0;

/// Rounds a double below 2^51 to the nearest integer, ties to even.
#[inline(always)]
pub(super) fn by_pivot(x: f64) -> f64 {
    (x + PIVOT) - PIVOT
}

/// Rounding of a double to an integer: the nearest integer (ties to even) of the number or of its magnitude, corrected
/// by one depending on the difference.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntegerRounding {
    /// Mask of the bits that are kept: all, or all but the sign.
    sign: u64,
    /// Thresholds of the difference: 1 is subtracted below `lower`, and added from `upper` on.
    pub(super) lower: f64,
    pub(super) upper: f64,
}

impl IntegerRounding {
    /// The number to be rounded: `x`, or its magnitude.
    #[inline(always)]
    pub(super) fn magnitude(&self, x: f64) -> f64 {
        f64::from_bits(x.to_bits() & self.sign)
    }

    /// Restores the sign of `x` that [`Self::magnitude`] removed.
    #[inline(always)]
    pub(super) fn signed(&self, rounded: f64, x: f64) -> f64 {
        f64::from_bits(rounded.to_bits() | x.to_bits() & !self.sign)
    }

    pub(super) const fn new(rounding: u8) -> IntegerRounding {
        const SIZE: u64 = u64::MAX >> 1;
        let never = f64::INFINITY;
        match rounding {
            EVEN => IntegerRounding { sign: u64::MAX, lower: -never, upper: never },
            AWAY => IntegerRounding { sign: SIZE, lower: -never, upper: 0.5 },
            ZERO => IntegerRounding { sign: SIZE, lower: 0.0, upper: never },
            UP => IntegerRounding { sign: u64::MAX, lower: -never, upper: f64::from_bits(1) },
            _ => IntegerRounding { sign: u64::MAX, lower: 0.0, upper: never },
        }
    }
}

/// Corrections of a quotient rounded to nearest even, by the sign of the remainder: `less` subtracts one and `more`
/// adds one. They apply to ties, or to every inexact quotient if `any` is -1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside {
    pub(super) less: [i32; 2],
    pub(super) more: [i32; 2],
    pub(super) any: i32,
}

impl Beside {
    pub(super) const fn new(rounding: u8) -> Beside {
        match rounding {
            EVEN => Beside { less: [0, 0], more: [0, 0], any: 0 },
            AWAY => Beside { less: [0, -1], more: [-1, 0], any: 0 },
            ZERO => Beside { less: [-1, 0], more: [0, -1], any: -1 },
            UP => Beside { less: [0, 0], more: [-1, -1], any: -1 },
            _ => Beside { less: [-1, -1], more: [0, 0], any: -1 },
        }
    }
}
