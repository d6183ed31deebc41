//! Lane arithmetic of normalized integers `nI.F`, in host integers: codes in units of `1 / (2^F - 1)`.

use super::fixed::FixedLane;
use super::float::GeneralLane;
use super::integer::{IntegerRounding, PIVOT, by_pivot};
use super::lane::Lane;
use super::power;
use super::reading::Reading;
use super::round::{AWAY, EVEN, rounding_index};
use crate::num::Format;

/// The arithmetic of one normalized format: `WRAP` is true if overflow wraps. Operations that do not depend on the unit
/// are integer operations on the codes.
///
/// Codes have at most 16 bits, and the denominator `D` at most 8: products of two codes fit an `i32`, and sums of four
/// products a double.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NormalizedLane<const WRAP: bool> {
    codes: FixedLane<false, WRAP>,
    int: u32,
    one: i32,
    /// `D` and its reciprocal, rounded.
    denominator: f64,
    reciprocal: f64,
    /// Rounding of a quotient by `D`.
    product: IntegerRounding,
    fused: bool,
}

/// Largest width of codes whose products a single rounds correctly.
const FUSED_WIDTH: u32 = 13;

impl<const WRAP: bool> NormalizedLane<WRAP> {
    /// Creates the arithmetic of a normalized format with these field widths.
    pub(crate) fn new(format: &Format, int_bits: u8, frac_bits: u8) -> Self {
        let rounding = rounding_index(format.rounding);
        let denominator = f64::from(format.denominator());
        NormalizedLane {
            codes: FixedLane::new(format, int_bits + frac_bits, 0),
            int: int_bits.into(),
            one: format.denominator().cast_signed(),
            denominator,
            reciprocal: 1.0 / denominator,
            // `D` is odd: no quotient lies in the middle between two integers.
            product: IntegerRounding::new(if rounding == AWAY { EVEN } else { rounding }),
            fused: matches!(rounding, EVEN | AWAY) && format.width() <= FUSED_WIDTH,
        }
    }

    /// Computes `v / D`, rounded, and saturated or wrapped, for integers of at most 33 bits.
    ///
    /// The nearest integer is right: quotients lie at least `1 / 2D` from the midpoint of two integers, and the error
    /// of the double is below `2^-20`. The remainder is exact and shows on which side of the quotient it lies.
    #[inline(always)]
    fn over(&self, v: f64) -> i32 {
        let value = self.product.magnitude(v);
        let near = by_pivot(value * self.reciprocal);
        let rest = value - near * self.denominator;
        let less = if rest < self.product.lower { 1.0 } else { 0.0 };
        let more = if rest >= self.product.upper { 1.0 } else { 0.0 };
        self.codes.fit32((self.product.signed(near - less + more, v) + PIVOT).to_bits() as i32)
    }

    /// `floor(a / D)`
    #[inline(always)]
    fn whole(&self, a: i32) -> i32 {
        let near = (f64::from(a) * self.reciprocal + PIVOT).to_bits() as i32;
        near - i32::from(near * self.one > a)
    }
}

impl<const WRAP: bool> Lane for NormalizedLane<WRAP> {
    type T = i32;
    type General = GeneralLane;

    #[inline(always)]
    fn decode(&self, bits: u32) -> i32 {
        self.codes.decode(bits)
    }

    #[inline(always)]
    fn encode(&self, x: i32) -> u32 {
        self.codes.encode(x)
    }

    /// The nearest double. It rounds into every other format like the exact number: a number that isn't an integer
    /// differs by at least one part in `2^42` from every number of another format, and from every midpoint.
    #[inline(always)]
    fn to_f64(&self, x: i32) -> f64 {
        f64::from(x) / self.denominator
    }

    fn reading(&self) -> Reading {
        Reading::Integer { one: self.one, units: self.denominator }
    }

    /// Twice the number of units is exact for doubles of up to 44 bits. For a longer result (a quotient, rounded to odd
    /// or to nearest) the error is less than one part in `2^51`; a result that close to an integer is treated as that
    /// integer. In units of 1/255, sums of texels with four weights of 8 bits lie at least one part in `2^49` apart. In
    /// other units that is proved for channels of up to 8 bits; sums of 16-bit channels come closer with a probability
    /// of about one in a billion.
    #[inline(always)]
    fn round_f64(&self, x: f64) -> i32 {
        const NEAR: f64 = 1.0 / (1u64 << 50) as f64;
        let halves = x * (2.0 * self.denominator);
        let integer = halves.round_ties_even();
        let meant = if (halves - integer).abs() <= integer.abs() * NEAR { integer } else { halves };
        self.codes.round_f64(0.5 * meant)
    }

    #[inline(always)]
    fn add(&self, a: i32, b: i32) -> i32 {
        self.codes.add(a, b)
    }

    #[inline(always)]
    fn sub(&self, a: i32, b: i32) -> i32 {
        self.codes.sub(a, b)
    }

    #[inline(always)]
    fn mul(&self, a: i32, b: i32) -> i32 {
        self.over(f64::from(a * b))
    }

    const FUSED: bool = !WRAP;

    #[inline(always)]
    fn is_fused(&self) -> bool {
        Self::FUSED && self.fused
    }

    /// Both the unit and its product with a factor are rounded, so the relative error is at most `2^-23`, and the error
    /// is less than `2^-10` where the result is in range. That is less than `1 / 2D`, the least distance of the exact
    /// product from a midpoint of two codes, so the sum with the pivot is rounded to the right code.
    #[inline(always)]
    fn fused_sum<const N: usize>(&self, a: [i32; N], b: [i32; N]) -> i32 {
        self.codes.fused_sum_of(self.reciprocal as f32, a, b)
    }

    #[inline(always)]
    fn fused_mad(&self, a: i32, b: i32, c: i32) -> i32 {
        self.over(f64::from(a * b + c * self.one))
    }

    #[inline(always)]
    fn exact_dot<const N: usize>(&self, a: [i32; N], b: [i32; N]) -> i32 {
        let mut sum = 0.0;
        for k in 0..N {
            sum += f64::from(a[k] * b[k]);
        }
        self.over(sum)
    }

    #[inline(always)]
    fn div(&self, a: i32, b: i32) -> i32 {
        let quotient = self.codes.quotient(a * self.one, b);
        if b == 0 { self.codes.by_zero(a) } else { quotient }
    }

    fn sqrt(&self, a: i32) -> i32 {
        if a <= 0 {
            return 0;
        }
        // In units, the root is sqrt(a D); it is computed with 16 guard bits.
        let square = u128::from((a * self.one).unsigned_abs()) << 32;
        let root = square.isqrt();
        self.codes.finish(false, root, 16, root * root != square)
    }

    #[inline(always)]
    fn rcp(&self, a: i32) -> i32 {
        let quotient = self.codes.quotient(self.one * self.one, a);
        if a == 0 { self.codes.by_zero(1) } else { quotient }
    }

    fn rsq(&self, a: i32) -> i32 {
        if a <= 0 {
            return if a == 0 { self.codes.by_zero(1) } else { 0 };
        }
        // In units, the result is sqrt(D^3 / a); it is computed with 40 guard bits.
        let (dividend, divisor) = (u128::from(self.one.unsigned_abs()).pow(3) << 80, u128::from(a.unsigned_abs()));
        let root = (dividend / divisor).isqrt();
        self.codes.finish(false, root, 40, root * root * divisor != dividend)
    }

    fn exp2(&self, a: i32) -> i32 {
        // An exponential out of range saturates even in a wrapping format.
        if self.whole(a) >= self.int.cast_signed() && WRAP {
            return self.codes.by_zero(1);
        }
        self.round_f64(power::exp2(self.to_f64(a)))
    }

    fn log2(&self, a: i32) -> i32 {
        match a {
            0 => self.codes.by_zero(-1),
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
        self.codes.fit32(self.whole(a) * self.one)
    }

    #[inline(always)]
    fn frc(&self, a: i32) -> i32 {
        a - self.whole(a) * self.one
    }

    #[inline(always)]
    fn neg(&self, a: i32) -> i32 {
        self.codes.neg(a)
    }

    #[inline(always)]
    fn abs(&self, a: i32) -> i32 {
        self.codes.abs(a)
    }

    #[inline(always)]
    fn scale(&self, a: i32, shift: i32) -> i32 {
        self.codes.scale(a, shift)
    }

    #[inline(always)]
    fn saturate(&self, a: i32) -> i32 {
        a.max(0).min(self.one)
    }

    #[inline(always)]
    fn above_half(&self, a: i32) -> bool {
        2 * a > self.one
    }
}
