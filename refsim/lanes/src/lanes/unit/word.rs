//! Single floats as words: fields, and functions that assemble words.

use crate::lanes::layout::pow2;
use crate::lanes::round::ZERO;
use crate::lanes::toward;

pub(super) const SIGN: u32 = 1 << 31;
/// Mask of the exponent field; on its own, the word of infinity.
pub(super) const FIELD: u32 = 0x7f80_0000;
pub(super) const MANTISSA: u32 = 0x7f_ffff;
pub(super) const ONE: u32 = 0x3f80_0000;
/// The NaN that units generate.
pub(super) const NAN: u32 = 0x7fff_ffff;

#[inline(always)]
pub(super) fn field(w: u32) -> i32 {
    (w >> 23 & 0xff).cast_signed()
}

#[inline(always)]
pub(super) fn is_nan(w: u32) -> bool {
    (w & !SIGN).cast_signed() > FIELD.cast_signed()
}

/// `x / 2^bits` rounded down, for an integer `x`.
#[inline(always)]
pub(super) fn halved(x: f64, bits: i32) -> f64 {
    (x * pow2(-bits)).floor()
}

/// Converts a double that is an integer below `2^32`. A cast would not be vectorized.
#[inline(always)]
pub(super) fn whole(x: f64) -> u32 {
    (x + pow2(52)).to_bits() as u32
}

/// Assembles a word from an exponent field, which may be out of range, and a significand with its leading one, or a
/// mantissa.
#[inline(always)]
pub(super) fn assembled(sign: u32, field: i32, significand: u32) -> u32 {
    let normal = field.cast_unsigned() << 23 | significand & MANTISSA;
    let magnitude = if field >= 255 { FIELD } else { normal };
    sign | if field <= 0 { 0 } else { magnitude }
}

/// Mask of the bits by which a double exceeds a float of 24 bits.
pub(super) const SURPLUS: u64 = (1 << 29) - 1;

#[inline(always)]
pub(super) fn is_zero(w: u32) -> bool {
    w & FIELD == 0
}

/// The significand of a normal number, in units of `2^(field - 150)`.
#[inline(always)]
pub(super) fn significand(w: u32) -> u32 {
    w & MANTISSA | 1 << 23
}

/// Replaces a subnormal number by zero.
#[inline(always)]
pub(super) fn flushed(w: u32) -> u32 {
    if is_zero(w) { w & SIGN } else { w }
}

/// All ones if a condition holds, else 0.
#[inline(always)]
pub(super) fn mask(condition: bool) -> u32 {
    if condition { u32::MAX } else { 0 }
}

/// `a b` with the bits beyond 24 dropped; rounded or truncated if the result is not a normal number. `FUSED` is `true`
/// if the host has fused multiply-add.
#[inline(always)]
pub(super) fn cut_product<const FUSED: bool>(a: u32, b: u32) -> f32 {
    let (a, b) = (f32::from_bits(a), f32::from_bits(b));
    if FUSED { toward::product::<ZERO>(a, b) } else { cut_double(f64::from(a) * f64::from(b)) }
}

/// Truncates a double to a single; rounds it if it is not a normal number.
#[inline(always)]
pub(super) fn cut_double(x: f64) -> f32 {
    f64::from_bits(x.to_bits() & !SURPLUS) as f32
}

/// Smallest and largest magnitude in a vectorized computation, which is right far from the ends of the format. It
/// tracks minima and maxima, because loops with conditions are not vectorized.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Met {
    /// The largest magnitude.
    largest: u32,
    /// Smallest nonzero magnitude of the largest addend of a sum, minus 1.
    addend: u32,
    /// Smallest nonzero magnitude of a product, minus 1.
    product: u32,
}

impl Met {
    pub(crate) const NONE: Self = Self { largest: 0, addend: u32::MAX, product: u32::MAX };

    /// The magnitude range of a product, or of another result that may be wrong near zero.
    #[inline(always)]
    pub(super) fn product(word: u32) -> Self {
        let largest = word & !SIGN;
        Self { largest, product: largest.wrapping_sub(1), ..Self::NONE }
    }

    /// The range of a sum's addends, given the magnitude of the largest.
    #[inline(always)]
    pub(super) fn addends(largest: u32) -> Self {
        Self { largest, addend: largest.wrapping_sub(1), ..Self::NONE }
    }

    /// Union of the ranges of two computations.
    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            largest: self.largest.max(other.largest),
            addend: self.addend.min(other.addend),
            product: self.product.min(other.product),
        }
    }

    /// Returns `true` if results may be wrong: for special values; for sums that may overflow or depend on subnormal
    /// addends; and for products up to the smallest normal number, to which they may have been rounded.
    #[inline(always)]
    pub(crate) fn is_risky(self) -> bool {
        self.largest >= 252 << 23 || self.addend < (64 << 23) - 1 || self.product < 1 << 23
    }
}

/// Truncates `magnitude * 2^-bits` to a single of 24 bits; `magnitude` is above 0, and the result normal.
pub(super) fn cut(negative: bool, magnitude: u64, bits: i32) -> u32 {
    let zeros = magnitude.leading_zeros();
    let place = 63 - zeros.cast_signed();
    let fraction = ((magnitude << zeros) >> 40) as u32 & MANTISSA;
    u32::from(negative) << 31 | (127 + place - bits).cast_unsigned() << 23 | fraction
}

/// [`cut`] with a sign: a negative number is represented by its one's complement; 0 gives +0.
pub(super) fn cut_complement(value: i64, bits: i32) -> u32 {
    let negative = value < 0;
    match (if negative { !value } else { value }).cast_unsigned() {
        0 => u32::from(negative) << 31,
        magnitude => cut(negative, magnitude, bits),
    }
}
