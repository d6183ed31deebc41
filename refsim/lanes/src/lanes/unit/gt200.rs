//! The unit of GT200: sums and products of the host where these are exact or rounded once. Branch-free, for loops of
//! vector code; rounding toward zero too.

use super::word::{NAN, ONE, SIGN, flushed, is_nan, is_zero, mask};
use crate::lanes::odd;
use crate::num::{Format, Rounding, Unit};

/// Bits of a double that a float of 24 bits does not have.
const SURPLUS: u64 = (1 << 29) - 1;
/// `2^-126 (1 - 2^-25)`: smaller numbers, rounded to 24 bits, are below the least normal number.
const LEAST: f64 = f64::from_bits((1023 - 126) << 52) * (1.0 - f64::from_bits((1023 - 25) << 52));

/// The state of the unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gt200 {
    /// Sums and products are rounded toward zero, those of MAD never.
    toward_zero: bool,
    zero_wins: bool,
}

/// A subnormal as a zero.
#[inline(always)]
fn number(w: u32) -> f64 {
    f64::from(f32::from_bits(flushed(w)))
}

/// The word of a result that is rounded: without subnormals, of one NaN.
#[inline(always)]
fn word(x: f32) -> u32 {
    if x.is_nan() { NAN } else { flushed(x.to_bits()) }
}

impl Gt200 {
    pub(super) fn new(format: &Format) -> Self {
        Self { toward_zero: format.rounding == Rounding::TowardZero, zero_wins: format.unit == Unit::Gt200ZeroWins }
    }

    /// Rounds a double, exact or rounded to odd.
    #[inline(always)]
    fn rounded(self, x: f64) -> u32 {
        let near = x as f32;
        let beyond = self.toward_zero & (f64::from(near).abs() > x.abs());
        let kept = f32::from_bits(near.to_bits().wrapping_sub(u32::from(beyond)));
        if x.abs() < LEAST { (x as f32).to_bits() & SIGN } else { word(kept) }
    }

    /// `a + b`
    #[inline(always)]
    pub(super) fn add(self, a: u32, b: u32) -> u32 {
        self.rounded(odd::add_odd(number(a), number(b)))
    }

    /// [`Self::add`] in vector code, and all ones if it may be wrong. A sum below the least normal number is exact.
    #[inline(always)]
    pub(super) fn quick_add(self, a: u32, b: u32) -> (u32, u32) {
        (word(f32::from_bits(flushed(a)) + f32::from_bits(flushed(b))), mask(self.toward_zero))
    }

    /// The exact product, or a zero that wins.
    #[inline(always)]
    fn product(self, a: u32, b: u32) -> f64 {
        let product = number(a) * number(b);
        if self.zero_wins & (is_zero(a) | is_zero(b)) { 0.0 } else { product }
    }

    /// `a b`
    #[inline(always)]
    pub(super) fn mul(self, a: u32, b: u32) -> u32 {
        self.rounded(self.product(a, b))
    }

    /// `a b + c`
    #[inline(always)]
    pub(super) fn mad(self, a: u32, b: u32, c: u32) -> u32 {
        let nearest = Self { toward_zero: false, ..self };
        let product = self.product(a, b);
        let cut = f64::from_bits(product.to_bits() & !SURPLUS);
        // Below the least normal number the host rounds as the unit does.
        let sum = word(odd::add_odd(cut, number(c)) as f32);
        // Without an addend the product is rounded.
        let alone = f32::from_bits(nearest.rounded(product)) + f32::from_bits(flushed(c));
        if is_zero(c) { word(alone) } else { sum }
    }

    /// The first product, and MAD for the others.
    #[inline(always)]
    pub(super) fn dot<const N: usize>(self, a: [u32; N], b: [u32; N]) -> u32 {
        let mut sum = self.mul(a[0], b[0]);
        for k in 1..N {
            sum = self.mad(a[k], b[k], sum);
        }
        sum
    }

    /// `a < b` of numbers.
    #[inline(always)]
    pub(super) fn less(a: u32, b: u32) -> bool {
        f32::from_bits(flushed(a)) < f32::from_bits(flushed(b))
    }

    /// `a == b` of numbers.
    #[inline(always)]
    pub(super) fn equal(a: u32, b: u32) -> bool {
        f32::from_bits(flushed(a)) == f32::from_bits(flushed(b))
    }

    /// MIN, or MAX if `flip` is all ones: the order of integers, turned around.
    #[inline(always)]
    pub(super) fn choose(a: u32, b: u32, flip: u32) -> u32 {
        let (a, b) = (flushed(a), flushed(b));
        let key = |w: u32| (w ^ mask(w & SIGN != 0) >> 1 ^ flip).cast_signed();
        let chosen = if key(a) < key(b) { a } else { b };
        let chosen = if is_nan(a) { b } else { chosen };
        let chosen = if is_nan(b) { a } else { chosen };
        if is_nan(a) & is_nan(b) { NAN } else { chosen }
    }

    /// `x` clamped to [0, 1].
    #[inline(always)]
    pub(super) fn saturate(x: u32) -> u32 {
        let positive = if x & SIGN == 0 { flushed(x).min(ONE) } else { 0 };
        if is_nan(x) { NAN } else { positive }
    }

    /// `x 2^shift`
    #[inline(always)]
    pub(super) fn scale(self, x: u32, shift: i32) -> u32 {
        self.rounded(number(x) * crate::lanes::layout::pow2(shift))
    }

    /// The largest integer not above `x`; a zero keeps its sign.
    #[inline(always)]
    pub(super) fn floor(x: u32) -> u32 {
        word(number(x).floor() as f32)
    }
}
