//! The vertex unit of NV20 to NV35: products cut to 24 bits, sums of aligned addends.
//!
//! [`Nv::mul`] and [`Nv::sum`] are right for all words. The quick versions are for loops of vector code. They compute
//! in host floats, and mark what these may get wrong: special values, and numbers near the ends of the range.

use super::word::{FIELD, MANTISSA, NAN, SIGN, field, is_nan, is_zero, mask, significand};
use crate::num::Unit;

/// Bits of a double that a float of 24 bits does not have.
const SURPLUS: u64 = (1 << 29) - 1;
/// Sums whose largest addend is from this number on are computed in host floats: no bit of a subnormal addend counts.
const LOW: u32 = 64 << 23;
/// The first number too large for that: four addends below it have a sum in range.
const HIGH: u32 = 252 << 23;

/// The state of the unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nv {
    /// NV20 and NV25: sums and products have no infinity, and subnormal addends count.
    pub(super) is_2x: bool,
    /// As programs of GL_NV_vertex_program2 see it: NaN and infinities count everywhere, -0 equals +0.
    pub(super) modern: bool,
}

impl Nv {
    pub(super) fn new(unit: Unit) -> Self {
        Self { is_2x: unit == Unit::Nv2x, modern: unit == Unit::Nv3x }
    }

    /// A result of any exponent, of which the significand has its leading one at bit 23.
    fn packed(self, sign: u32, exponent: i32, significand: u32) -> u32 {
        let magnitude = match exponent {
            ..=0 => 0,
            255.. if self.is_2x => FIELD - 1,
            255.. => FIELD,
            _ => exponent.cast_unsigned() << 23 | significand & MANTISSA,
        };
        sign | magnitude
    }

    /// `a b`
    pub(super) fn mul(self, a: u32, b: u32) -> u32 {
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

    /// The sum of up to four addends.
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

    /// The sum of products.
    pub(super) fn dot<const N: usize>(self, a: [u32; N], b: [u32; N]) -> u32 {
        self.sum::<N>(std::array::from_fn(|k| self.mul(a[k], b[k])))
    }

    /// The place of a word in the order of comparisons, which is that of integers.
    #[inline(always)]
    fn key(self, w: u32) -> i32 {
        let key = (w ^ mask(w & SIGN != 0) >> 1).cast_signed();
        if self.modern & is_zero(w) { 0 } else { key }
    }

    /// Returns `true` if two words have no order.
    #[inline(always)]
    pub(super) fn unordered(self, a: u32, b: u32) -> bool {
        self.modern & (is_nan(a) | is_nan(b))
    }

    /// `a < b` of ordered words.
    #[inline(always)]
    pub(super) fn below(self, a: u32, b: u32) -> bool {
        self.key(a) < self.key(b)
    }

    /// `a == b` of ordered words.
    #[inline(always)]
    pub(super) fn same(self, a: u32, b: u32) -> bool {
        self.key(a) == self.key(b)
    }

    /// FLR.
    pub(super) fn floor(x: u32) -> u32 {
        let (e, negative) = (field(x), x & SIGN != 0);
        match e {
            255 if is_nan(x) => NAN,
            0 => 0,
            150.. => x,
            ..127 => {
                if negative {
                    0xbf80_0000
                } else {
                    0
                }
            }
            _ => {
                let fraction = MANTISSA >> (e - 127);
                (if negative { x + fraction } else { x }) & !fraction
            }
        }
    }

    /// `a b` in vector code, and all ones if the result may be wrong.
    #[inline(always)]
    pub(super) fn quick_mul(a: u32, b: u32) -> (u32, u32) {
        let exact = f64::from(f32::from_bits(a)) * f64::from(f32::from_bits(b));
        let product = (f64::from_bits(exact.to_bits() & !SURPLUS) as f32).to_bits();
        let magnitude = product & !SIGN;
        // The smallest normal number may have been rounded up to.
        let low = (magnitude != 0) & (magnitude.cast_signed() <= 1 << 23);
        let strange = low | (magnitude.cast_signed() >= FIELD.cast_signed());
        let zero = (a & FIELD).cast_signed().min((b & FIELD).cast_signed()) == 0;
        (if zero { 0 } else { product }, mask(strange))
    }

    /// The sum of addends in vector code, and all ones if the result may be wrong.
    ///
    /// An addend times a power of two, cut to an integer, is the addend as the adder aligns it.
    #[inline(always)]
    pub(super) fn quick_sum<const N: usize>(addends: [u32; N]) -> (u32, u32) {
        let mut largest = 0i32;
        for w in addends {
            largest = largest.max((w & !SIGN).cast_signed());
        }
        let low = (largest != 0) & (largest < LOW.cast_signed());
        let strange = low | (largest >= HIGH.cast_signed());
        let top = largest & FIELD.cast_signed();
        let scale = f32::from_bits((282u32 << 23).wrapping_sub(top.cast_unsigned()));
        let mut sum = 0i32;
        for w in addends {
            sum = sum.wrapping_add((f32::from_bits(w) * scale) as i32);
        }
        let magnitude = sum.wrapping_abs();
        // As many low bits are cut as there are beyond 24.
        let mut beyond = magnitude >> 24;
        beyond |= beyond >> 1;
        beyond |= beyond >> 2;
        beyond |= beyond >> 4;
        let float = ((magnitude & !beyond) as f32).to_bits();
        let moved = float.wrapping_add(top.cast_unsigned()).wrapping_sub(155 << 23);
        let word = moved | sum.cast_unsigned() & SIGN;
        (if sum == 0 { 0 } else { word }, mask(strange))
    }

    /// The sum of products in vector code.
    #[inline(always)]
    pub(super) fn quick_dot<const N: usize>(a: [u32; N], b: [u32; N]) -> (u32, u32) {
        let (mut products, mut strange) = ([0; N], 0);
        for k in 0..N {
            let (product, mark) = Self::quick_mul(a[k], b[k]);
            products[k] = product;
            strange |= mark;
        }
        let (sum, mark) = Self::quick_sum(products);
        (sum, strange | mark)
    }
}
