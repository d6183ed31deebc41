//! The vertex unit of NV20 to NV35: products truncated to 24 bits, sums of aligned addends.
//!
//! [`Nv::mul`] and [`Nv::sum`] are right for all words. The `quick_` versions are vectorized: they compute in host
//! floats and return the range of magnitudes encountered, which shows whether their results may be wrong.

use super::card::CardUnit;
use super::tables::{NV, Tables};
use super::word::{
    FIELD, MANTISSA, Met, NAN, ONE, SIGN, cut_double, cut_product, field, flushed, is_nan, is_zero, mask, significand,
};
use crate::num::{Format, Unit};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Nv {
    /// NV20 and NV25: sums and products have no infinity, and subnormal addends count.
    pub(super) is_2x: bool,
    /// Rules of GL_NV_vertex_program2: NaN and infinities are not ignored, and -0 equals +0.
    pub(super) modern: bool,
    pub(super) tables: &'static Tables<64, 1>,
}

impl Nv {
    /// Packs a result of any exponent; the significand has its leading one at bit 23.
    fn packed(self, sign: u32, exponent: i32, significand: u32) -> u32 {
        let magnitude = match exponent {
            ..=0 => 0,
            255.. if self.is_2x => FIELD - 1,
            255.. => FIELD,
            _ => exponent.cast_unsigned() << 23 | significand & MANTISSA,
        };
        sign | magnitude
    }

    pub(super) fn sum<const N: usize>(self, addends: [u32; N]) -> u32 {
        let has = |word: u32| addends.contains(&word);
        let (plus, minus) = (has(FIELD), has(FIELD | SIGN));
        if addends.into_iter().any(is_nan) || plus && minus {
            return NAN;
        }
        if plus || minus {
            return if plus { FIELD } else { FIELD | SIGN };
        }
        let top = addends.into_iter().map(field).max().unwrap_or(0);
        let aligned = |w: u32| {
            let kept = match is_zero(w) {
                true if self.is_2x => w & MANTISSA,
                true => 0,
                false => significand(w),
            };
            let magnitude = (kept << 5 >> (top - field(w)).min(31)).cast_signed();
            if w & SIGN == 0 { magnitude } else { -magnitude }
        };
        let sum: i32 = addends.into_iter().map(aligned).sum();
        if sum == 0 {
            return 0;
        }
        let magnitude = sum.unsigned_abs();
        let zeros = magnitude.leading_zeros();
        self.packed(sum.cast_unsigned() & SIGN, top + 3 - zeros.cast_signed(), magnitude << zeros >> 8)
    }

    /// Key of a word for comparisons as integers.
    #[inline(always)]
    fn key(self, w: u32) -> i32 {
        let key = (w ^ mask(w & SIGN != 0) >> 1).cast_signed();
        if self.modern & is_zero(w) { 0 } else { key }
    }

    /// Two powers of two: the first scales the last bit of an aligned addend to 1, the second undoes that.
    #[inline(always)]
    fn scales(largest: u32) -> [f32; 2] {
        let top = largest & FIELD;
        [(282u32 << 23).wrapping_sub(top), top.wrapping_sub(28 << 23)].map(f32::from_bits)
    }

    /// The sum of addends, vectorized: each is truncated to an integer in units of the last aligned bit, and the sum of
    /// these is exact in doubles.
    #[inline(always)]
    fn quick_sum<const N: usize>(addends: [u32; N]) -> (u32, Met) {
        let mut largest = 0;
        for w in addends {
            largest = largest.max(w & !SIGN);
        }
        let [up, down] = Self::scales(largest);
        let aligned = |w: u32| f64::from((f32::from_bits(w) * up).trunc());
        let mut sum = aligned(addends[0]);
        for w in &addends[1..] {
            sum += aligned(*w);
        }
        // No sum is -0.
        ((cut_double(sum) * down + 0.0).to_bits(), Met::addends(largest))
    }
}

impl CardUnit for Nv {
    const SETS_NAN: bool = true;

    fn new(format: &Format) -> Self {
        Self { is_2x: format.unit == Unit::Nv2x, modern: format.unit == Unit::Nv3x, tables: &NV }
    }

    fn mul(&self, a: u32, b: u32) -> u32 {
        let (e, d) = (field(a), field(b));
        if e.min(d) == 0 {
            return if self.modern && e.max(d) == 255 { NAN } else { 0 };
        }
        let sign = (a ^ b) & SIGN;
        if is_nan(a) || is_nan(b) {
            return NAN;
        }
        if e.max(d) == 255 {
            return sign | FIELD;
        }
        let product = u64::from(significand(a)) * u64::from(significand(b));
        let carry = (product >> 47) as i32;
        self.packed(sign, e + d - 127 + carry, (product >> (23 + carry)) as u32)
    }

    fn dot<const N: usize>(&self, a: [u32; N], b: [u32; N]) -> u32 {
        self.sum::<N>(std::array::from_fn(|k| self.mul(a[k], b[k])))
    }

    fn add(&self, a: u32, b: u32) -> u32 {
        self.sum([a, b])
    }

    fn mad(&self, a: u32, b: u32, c: u32) -> u32 {
        self.sum([self.mul(a, b), c])
    }

    #[inline(always)]
    fn quick_add(&self, a: u32, b: u32) -> (u32, Met) {
        let (x, y) = (a & !SIGN, b & !SIGN);
        let (largest, least) = (x.max(y), x.min(y));
        let [up, down] = Self::scales(largest);
        // Alignment truncates only the lesser addend. The sum is a magnitude; the host's sum gives the sign.
        let aligned = (f32::from_bits(least) * up).trunc() * down;
        let other = f32::from_bits(aligned.to_bits() ^ (a ^ b) & SIGN);
        let sum = f32::from_bits(largest) + other;
        let above = sum - f32::from_bits(largest) > other;
        let sign = (f32::from_bits(a) + f32::from_bits(b) + 0.0).to_bits() & SIGN;
        (sum.to_bits().wrapping_sub(above.into()) | sign, Met::addends(largest))
    }

    #[inline(always)]
    fn quick_mul<const FUSED: bool>(&self, a: u32, b: u32) -> (u32, Met) {
        let product = cut_product::<FUSED>(a, b).to_bits();
        (if is_zero(a) | is_zero(b) { 0 } else { product }, Met::product(product))
    }

    #[inline(always)]
    fn quick_mad<const FUSED: bool>(&self, a: u32, b: u32, c: u32) -> (u32, Met) {
        let (product, met) = self.quick_mul::<FUSED>(a, b);
        let (sum, of_sum) = self.quick_add(product, c);
        (sum, met.and(of_sum))
    }

    #[inline(always)]
    fn quick_dot<const FUSED: bool, const N: usize>(&self, a: [u32; N], b: [u32; N]) -> (u32, Met) {
        let (mut products, mut met) = ([0; N], Met::NONE);
        for k in 0..N {
            let (product, of_product) = self.quick_mul::<FUSED>(a[k], b[k]);
            products[k] = product;
            met = met.and(of_product);
        }
        let (sum, of_sum) = Self::quick_sum(products);
        (sum, met.and(of_sum))
    }

    #[inline(always)]
    fn unordered(&self, a: u32, b: u32) -> bool {
        self.modern & (is_nan(a) | is_nan(b))
    }

    #[inline(always)]
    fn below(&self, a: u32, b: u32) -> bool {
        self.key(a) < self.key(b)
    }

    #[inline(always)]
    fn same(&self, a: u32, b: u32) -> bool {
        self.key(a) == self.key(b)
    }

    #[inline(always)]
    fn min(&self, a: u32, b: u32) -> u32 {
        let chosen = if self.below(a, b) { a } else { b };
        if self.unordered(a, b) { NAN } else { chosen }
    }

    #[inline(always)]
    fn max(&self, a: u32, b: u32) -> u32 {
        let chosen = if self.below(a, b) { b } else { a };
        if self.unordered(a, b) { NAN } else { chosen }
    }

    /// FLR, which has no -0.
    #[inline(always)]
    fn floor(&self, x: u32) -> u32 {
        let whole = f32::from_bits(flushed(x)).floor() + 0.0;
        if is_nan(x) { NAN } else { whole.to_bits() }
    }

    /// The unit has no saturation; NaN gives 0, as in ideal formats.
    #[inline(always)]
    fn saturate(&self, x: u32) -> u32 {
        if (x & SIGN != 0) | is_nan(x) { 0 } else { flushed(x).min(ONE) }
    }
}
