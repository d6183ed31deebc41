//! Lane arithmetic of the fixed-point formats `sI.F`, in host integers.

use super::float::GeneralLane;
use super::integer::{Beside, IntegerRounding, PIVOT, Shift};
use super::lane::Lane;
use super::power;
use super::reading::Reading;
use super::round::{EVEN, rounding_index};
use crate::num::Format;

/// 1.5 * 2^23: adding it rounds a single of up to 22 bits to an integer, which is then in the sum's low bits.
const SINGLE_PIVOT: f32 = 12_582_912.0;
const SINGLE_PIVOT_BITS: i32 = SINGLE_PIVOT.to_bits().cast_signed();

/// The arithmetic of one fixed-point format: `WIDE` is true for more than 16 bits, `WRAP` if overflow wraps.
///
/// No sum or product of numbers of the format overflows its host type: `i32` up to 16 bits, where `|a b| <= 2^30` and
/// `|c 2^F| <= 2^30` (`+2^30` is impossible for the latter), and `i64` above. The common operations still use wrapping
/// instructions: overflow checks would prevent vectorization.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FixedLane<const WIDE: bool, const WRAP: bool> {
    rounding: u8,
    frac: u32,
    int: u32,
    width: u32,
    low: i32,
    high: i32,
    one: i32,
    product: Shift,
    whole: IntegerRounding,
    beside: Beside,
}

/// Divides by `2^count` and rounds; the same body for both widths.
macro_rules! round_shift {
    ($name:ident, $t:ty, $sign:literal) => {
        #[inline(always)]
        fn $name(&self, v: $t, shift: &Shift) -> $t {
            let at = if shift.by_sign { $sign } else { shift.count };
            let correction = v.wrapping_shr(at) & shift.mask as $t;
            v.wrapping_add(shift.more as $t).wrapping_add(correction).wrapping_shr(shift.count)
        }
    };
}

impl<const WIDE: bool, const WRAP: bool> FixedLane<WIDE, WRAP> {
    /// Creates the arithmetic of a fixed-point format with these field widths.
    pub(crate) fn new(format: &Format, int_bits: u8, frac_bits: u8) -> Self {
        let bits = u32::from(int_bits) + u32::from(frac_bits);
        let high = ((1i64 << bits) - 1) as i32;
        let one = (1i64 << frac_bits).min(i64::from(high)) as i32;
        FixedLane {
            rounding: rounding_index(format.rounding),
            frac: u32::from(frac_bits),
            int: u32::from(int_bits),
            width: bits + 1,
            low: -high - 1,
            high,
            one,
            product: Shift::new(rounding_index(format.rounding), frac_bits.into()),
            whole: IntegerRounding::new(rounding_index(format.rounding)),
            beside: Beside::new(rounding_index(format.rounding)),
        }
    }

    round_shift!(round32, i32, 31);
    round_shift!(round64, i64, 63);
    round_shift!(round128, i128, 127);

    /// The low bits of the width, sign-extended.
    #[inline(always)]
    fn residue(&self, v: i32) -> i32 {
        let spare = 32_u32.wrapping_sub(self.width);
        v.wrapping_shl(spare).wrapping_shr(spare)
    }

    #[inline(always)]
    pub(super) fn fit32(&self, v: i32) -> i32 {
        if WRAP { self.residue(v) } else { v.max(self.low).min(self.high) }
    }

    #[inline(always)]
    fn fit64(&self, v: i64) -> i32 {
        if WRAP { self.residue(v as i32) } else { v.max(i64::from(self.low)).min(i64::from(self.high)) as i32 }
    }

    fn fit128(&self, v: i128) -> i32 {
        if WRAP { self.residue(v as i32) } else { v.clamp(self.low.into(), self.high.into()) as i32 }
    }

    /// Sum of products, each rounded to nearest even by adding the pivot. Rounding is monotonic, so products that are
    /// out of range stay out of range. The sum of `k` products contains `k` times the pivot's bits, and may wrap: the
    /// integers still compare in the right order.
    #[inline(always)]
    pub(super) fn fused_sum_of<const N: usize>(&self, unit: f32, a: [i32; N], b: [i32; N]) -> i32 {
        let (low, high) = (SINGLE_PIVOT + self.low as f32, SINGLE_PIVOT + self.high as f32);
        let (mut sum, mut offset) = (0i32, 0i32);
        for k in 0..N {
            #[expect(clippy::disallowed_methods, reason = "it must round once, and the host has the instruction")]
            let product = (a[k] as f32 * unit).mul_add(b[k] as f32, SINGLE_PIVOT);
            let above = if product > low { product } else { low };
            let fitted = if above < high { above } else { high };
            sum = sum.wrapping_add(fitted.to_bits().cast_signed());
            offset = offset.wrapping_add(SINGLE_PIVOT_BITS);
            if k > 0 {
                sum = sum.max(self.low.wrapping_add(offset)).min(self.high.wrapping_add(offset));
            }
        }
        sum.wrapping_sub(offset)
    }

    fn extreme(&self, negative: bool) -> i32 {
        if negative { self.low } else { self.high }
    }

    #[inline(always)]
    pub(super) fn by_zero(&self, a: i32) -> i32 {
        let extreme = self.extreme(a < 0);
        if a == 0 { 0 } else { extreme }
    }

    /// Computes `n / d` units for `|n| <= 2^30` and `|d| <= 2^15`, rounded, and saturated or wrapped; unspecified if
    /// `d` is zero.
    ///
    /// A quotient that is neither an integer nor an integer and a half differs from all of these by at least one part
    /// in `2^16`. The double's relative error is at most `2^-22`, so both are rounded alike. With saturation the
    /// quotient is clamped first; with wrapping it is an integer of at most 31 bits.
    #[inline(always)]
    pub(super) fn quotient(&self, n: i32, d: i32) -> i32 {
        let exact = f64::from(n) / f64::from(d);
        let (low, high) = (f64::from(self.low) - 1.0, f64::from(self.high) + 1.0);
        let above = if exact > low { exact } else { low };
        let clamped = if above < high { above } else { high };
        let near = (if WRAP { exact } else { clamped } + PIVOT).to_bits() as i32;
        // Positive where the exact quotient lies above the integer.
        let rest = n.wrapping_sub(near.wrapping_mul(d)).wrapping_mul(d.signum());
        let (below, beyond) = (rest >> 31, rest.wrapping_neg() >> 31);
        let positive = !((n ^ d) >> 31);
        let tie = if rest.unsigned_abs().wrapping_mul(2) == d.unsigned_abs() { -1 } else { 0 };
        let Beside { less, more, any } = self.beside;
        let down = below & (positive & less[0] | !positive & less[1]);
        let up = beyond & (positive & more[0] | !positive & more[1]);
        self.fit32(near.wrapping_add(down.wrapping_sub(up) & (tie | any)))
    }

    /// Rounds `magnitude / 2^guard` units, plus a bit more if `sticky`, then saturates or wraps. With `sticky`, `guard`
    /// is at least 2.
    pub(super) fn finish(&self, negative: bool, magnitude: u128, guard: u32, sticky: bool) -> i32 {
        // Two guard bits and a sticky bit suffice; lower bits are folded into the sticky bit.
        let (kept, guard, sticky) = if guard > 3 {
            let drop = (guard - 3).min(127);
            (magnitude >> drop, 3, sticky || magnitude & ((1 << drop) - 1) != 0)
        } else {
            (magnitude, guard, sticky)
        };
        let exact = (kept << 1 | u128::from(sticky)).cast_signed();
        self.fit128(self.round128(if negative { -exact } else { exact }, &Shift::new(self.rounding, guard + 1)))
    }
}

impl<const WIDE: bool, const WRAP: bool> Lane for FixedLane<WIDE, WRAP> {
    type T = i32;
    type General = GeneralLane;

    #[inline(always)]
    fn decode(&self, bits: u32) -> i32 {
        self.residue(bits.cast_signed())
    }

    #[inline(always)]
    fn encode(&self, x: i32) -> u32 {
        x as u32 & u32::MAX.wrapping_shr(32_u32.wrapping_sub(self.width))
    }

    #[inline(always)]
    fn to_f64(&self, x: i32) -> f64 {
        f64::from(x) / (1u64 << self.frac) as f64
    }

    fn reading(&self) -> Reading {
        Reading::Integer { one: self.one, units: (1u64 << self.frac) as f64 }
    }

    #[inline(always)]
    fn round_f64(&self, x: f64) -> i32 {
        // `x` in units. Scaling by a power of two, rounding to an integer and subtracting that integer are exact.
        let units = x * (1u64 << self.frac) as f64;
        let value = self.whole.magnitude(units);
        let near = value.round_ties_even();
        let rest = value - near;
        let less = if rest < self.whole.lower { 1.0 } else { 0.0 };
        let more = if rest >= self.whole.upper { 1.0 } else { 0.0 };
        let rounded = self.whole.signed(near - less + more, units);
        let (low, high) = (f64::from(self.low), f64::from(self.high));
        let above_low = if rounded > low { rounded } else { low };
        let clamped = if above_low < high { above_low } else { high };
        // The residue modulo `2^width`: first in [0, 2^width), then folded into the signed range.
        let size = (1u64 << self.width) as f64;
        let residue = rounded - (rounded * (1.0 / size)).floor() * size;
        let folded = residue - if residue > high { size } else { 0.0 };
        let value = if WRAP && units.abs() < f64::INFINITY { folded } else { clamped };
        let number = if x.is_nan() { 0.0 } else { value };
        (number + PIVOT).to_bits() as i32
    }

    #[inline(always)]
    fn add(&self, a: i32, b: i32) -> i32 {
        if WIDE { self.fit64(i64::from(a).wrapping_add(i64::from(b))) } else { self.fit32(a.wrapping_add(b)) }
    }

    #[inline(always)]
    fn sub(&self, a: i32, b: i32) -> i32 {
        if WIDE { self.fit64(i64::from(a).wrapping_sub(i64::from(b))) } else { self.fit32(a.wrapping_sub(b)) }
    }

    #[inline(always)]
    fn mul(&self, a: i32, b: i32) -> i32 {
        if WIDE {
            self.fit64(self.round64(i64::from(a).wrapping_mul(i64::from(b)), &self.product))
        } else {
            self.fit32(self.round32(a.wrapping_mul(b), &self.product))
        }
    }

    const FUSED: bool = !WIDE && !WRAP;

    #[inline(always)]
    fn is_fused(&self) -> bool {
        Self::FUSED && self.rounding == EVEN
    }

    /// The exact product plus the pivot, rounded once, is the product rounded to nearest even.
    #[inline(always)]
    fn fused_sum<const N: usize>(&self, a: [i32; N], b: [i32; N]) -> i32 {
        self.fused_sum_of(1.0 / (1u64 << self.frac) as f32, a, b)
    }

    /// In nearest-even rounding, the double quotient rounds like the exact one ([`Self::quotient`]).
    #[inline(always)]
    fn fused_div(&self, a: i32, b: i32) -> i32 {
        let exact = f64::from(a.wrapping_shl(self.frac)) / f64::from(b);
        let (low, high) = (f64::from(self.low), f64::from(self.high));
        let above = if exact > low { exact } else { low };
        let fitted = if above < high { above } else { high };
        let near = (fitted + PIVOT).to_bits() as i32;
        if b == 0 { self.by_zero(a) } else { near }
    }

    #[inline(always)]
    fn fused_mad(&self, a: i32, b: i32, c: i32) -> i32 {
        if WIDE {
            let addend = i64::from(c).wrapping_shl(self.frac);
            self.fit64(self.round64(i64::from(a).wrapping_mul(i64::from(b)).wrapping_add(addend), &self.product))
        } else {
            let sum = a.wrapping_mul(b).wrapping_add(c.wrapping_shl(self.frac));
            self.fit32(self.round32(sum, &self.product))
        }
    }

    #[inline(always)]
    fn exact_dot<const N: usize>(&self, a: [i32; N], b: [i32; N]) -> i32 {
        if WIDE {
            let mut sum = 0i128;
            for k in 0..N {
                sum += i128::from(a[k]) * i128::from(b[k]);
            }
            self.fit128(self.round128(sum, &self.product))
        } else {
            let mut sum = 0i64;
            for k in 0..N {
                sum = sum.wrapping_add(i64::from(a[k].wrapping_mul(b[k])));
            }
            self.fit64(self.round64(sum, &self.product))
        }
    }

    #[inline(always)]
    fn div(&self, a: i32, b: i32) -> i32 {
        if !WIDE {
            let quotient = self.quotient(a.wrapping_shl(self.frac), b);
            return if b == 0 { self.by_zero(a) } else { quotient };
        }
        if b == 0 {
            return self.by_zero(a);
        }
        let dividend = u128::from(a.unsigned_abs()) << (self.frac + 2);
        let divisor = u128::from(b.unsigned_abs());
        self.finish((a < 0) != (b < 0), dividend / divisor, 2, !dividend.is_multiple_of(divisor))
    }

    fn sqrt(&self, a: i32) -> i32 {
        if a <= 0 {
            return 0;
        }
        // In units, the root is sqrt(a 2^F); it is computed with 16 guard bits.
        let square = (a as u128) << (self.frac + 32);
        let root = square.isqrt();
        self.finish(false, root, 16, root * root != square)
    }

    #[inline(always)]
    fn rcp(&self, a: i32) -> i32 {
        if !WIDE {
            let quotient = self.quotient(1 << (2 * self.frac), a);
            return if a == 0 { self.high } else { quotient };
        }
        if a == 0 {
            return self.high;
        }
        let dividend = 1u128 << (2 * self.frac + 2);
        let divisor = u128::from(a.unsigned_abs());
        self.finish(a < 0, dividend / divisor, 2, !dividend.is_multiple_of(divisor))
    }

    fn rsq(&self, a: i32) -> i32 {
        if a <= 0 {
            return if a == 0 { self.high } else { 0 };
        }
        // In units, the result is sqrt(2^3F / a). The guard bits fill the rest of 127 bits: there are at least 16.
        let guard = (126 - 3 * self.frac) / 2;
        let (dividend, divisor) = (1u128 << (3 * self.frac + 2 * guard), a as u128);
        let square = dividend / divisor;
        let root = square.isqrt();
        let exact = dividend.is_multiple_of(divisor) && root * root == square;
        self.finish(false, root, guard, !exact)
    }

    fn exp2(&self, a: i32) -> i32 {
        // An exponential out of range saturates even in a wrapping format.
        if a >> self.frac >= self.int.cast_signed() && WRAP {
            return self.high;
        }
        self.round_f64(power::exp2(self.to_f64(a)))
    }

    fn log2(&self, a: i32) -> i32 {
        match a {
            0 => self.low,
            1.. => self.round_f64(power::log2(self.to_f64(a))),
            _ => 0,
        }
    }

    #[inline(always)]
    fn min(&self, a: i32, b: i32) -> i32 {
        a.min(b)
    }

    #[inline(always)]
    fn max(&self, a: i32, b: i32) -> i32 {
        a.max(b)
    }

    #[inline(always)]
    fn floor(&self, a: i32) -> i32 {
        a & !(self.product.dropped as i32)
    }

    #[inline(always)]
    fn frc(&self, a: i32) -> i32 {
        a & self.product.dropped as i32
    }

    #[inline(always)]
    fn neg(&self, a: i32) -> i32 {
        self.sub(0, a)
    }

    #[inline(always)]
    fn abs(&self, a: i32) -> i32 {
        let negated = self.sub(0, a);
        if a < 0 { negated } else { a }
    }

    #[inline(always)]
    fn scale(&self, a: i32, shift: i32) -> i32 {
        if !WIDE && shift >= 0 {
            self.fit32(a.wrapping_shl(shift.unsigned_abs()))
        } else if !WIDE {
            self.fit32(self.round32(a, &Shift::new(self.rounding, shift.unsigned_abs())))
        } else if shift >= 0 {
            self.fit64(i64::from(a).wrapping_shl(shift.unsigned_abs()))
        } else {
            self.fit64(self.round64(i64::from(a), &Shift::new(self.rounding, shift.unsigned_abs())))
        }
    }

    #[inline(always)]
    fn saturate(&self, a: i32) -> i32 {
        a.max(0).min(self.one)
    }

    #[inline(always)]
    fn above_half(&self, a: i32) -> bool {
        a > self.product.half as i32
    }
}
