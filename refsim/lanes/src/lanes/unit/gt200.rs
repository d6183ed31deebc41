//! The unit of GT200: host sums and products where these are exact or rounded once. The `quick_` versions are
//! vectorized and return the range of magnitudes encountered, which shows whether their results may be wrong.

use super::card::CardUnit;
use super::tables::{GT200, Tables};
use super::word::{Met, NAN, ONE, SIGN, SURPLUS, cut_product, flushed, is_nan, is_zero, mask};
use crate::lanes::odd;
use crate::lanes::round::ZERO;
use crate::lanes::toward;
use crate::num::{Format, Rounding, Unit};

/// `2^-126 (1 - 2^-25)`: smaller numbers stay below the least normal number when rounded to 24 bits.
const LEAST: f64 = f64::from_bits((1023 - 126) << 52) * (1.0 - f64::from_bits((1023 - 25) << 52));

#[derive(Clone, Copy, Debug)]
pub(crate) struct Gt200 {
    /// Sums and products are rounded toward zero, except in MAD.
    toward_zero: bool,
    zero_wins: bool,
    pub(super) tables: &'static Tables<128, 3>,
}

/// Returns `true` for GT200's conversion to half floats, which flushes magnitudes below `2^-33` in every rounding.
pub(crate) fn drops_small_halves(from: &Format, to: &Format) -> bool {
    matches!(from.unit, Unit::Gt200 | Unit::Gt200ZeroWins) && to.kind == Format::FP16.kind
}

/// Flushes a number as [`drops_small_halves`] describes.
#[inline(always)]
pub(crate) fn without_small(x: f64) -> f64 {
    let kept = if x.abs() < crate::lanes::layout::pow2(-33) { 0.0 } else { x };
    kept.copysign(x)
}

/// Converts a word to a double; a subnormal becomes zero.
#[inline(always)]
fn number(w: u32) -> f64 {
    f64::from(f32::from_bits(flushed(w)))
}

/// The word of a rounded result: subnormals become zero, and there is one NaN.
#[inline(always)]
fn word(x: f32) -> u32 {
    if x.is_nan() { NAN } else { flushed(x.to_bits()) }
}

impl Gt200 {
    /// Rounds a double, exact or rounded to odd.
    fn rounded(self, x: f64) -> u32 {
        let near = x as f32;
        let beyond = self.toward_zero & (f64::from(near).abs() > x.abs());
        let kept = f32::from_bits(near.to_bits().wrapping_sub(u32::from(beyond)));
        if x.abs() < LEAST { (x as f32).to_bits() & SIGN } else { word(kept) }
    }

    /// The exact product, or zero for a zero factor if zero wins.
    fn product(self, a: u32, b: u32) -> f64 {
        let product = number(a) * number(b);
        if self.zero_wins & (is_zero(a) | is_zero(b)) { 0.0 } else { product }
    }

    /// MIN, or MAX if `flip` is all ones, which reverses the order of the integers.
    #[inline(always)]
    fn choose(a: u32, b: u32, flip: u32) -> u32 {
        let (a, b) = (flushed(a), flushed(b));
        let key = |w: u32| (w ^ mask(w & SIGN != 0) >> 1 ^ flip).cast_signed();
        let chosen = if key(a) < key(b) { a } else { b };
        let chosen = if is_nan(a) { b } else { chosen };
        let chosen = if is_nan(b) { a } else { chosen };
        if is_nan(a) & is_nan(b) { NAN } else { chosen }
    }

    pub(super) fn scale(self, x: u32, shift: i32) -> u32 {
        self.rounded(number(x) * crate::lanes::layout::pow2(shift))
    }
}

impl CardUnit for Gt200 {
    const SETS_NAN: bool = false;

    fn new(format: &Format) -> Self {
        Self {
            toward_zero: format.rounding == Rounding::TowardZero,
            zero_wins: format.unit == Unit::Gt200ZeroWins,
            tables: &GT200,
        }
    }

    fn mul(&self, a: u32, b: u32) -> u32 {
        self.rounded(self.product(a, b))
    }

    /// Rounds the first product, then adds each further product with MAD.
    fn dot<const N: usize>(&self, a: [u32; N], b: [u32; N]) -> u32 {
        (1..N).fold(self.mul(a[0], b[0]), |sum, k| self.mad(a[k], b[k], sum))
    }

    fn add(&self, a: u32, b: u32) -> u32 {
        self.rounded(odd::add_odd(number(a), number(b)))
    }

    fn mad(&self, a: u32, b: u32, c: u32) -> u32 {
        let nearest = Self { toward_zero: false, ..*self };
        let product = self.product(a, b);
        let cut = f64::from_bits(product.to_bits() & !SURPLUS);
        // Below the least normal number the host rounds as the unit does.
        let sum = word(odd::add_odd(cut, number(c)) as f32);
        // With a zero addend the product is rounded.
        let alone = f32::from_bits(nearest.rounded(product)) + f32::from_bits(flushed(c));
        if is_zero(c) { word(alone) } else { sum }
    }

    /// Sums below the least normal number are exact.
    #[inline(always)]
    fn quick_add(&self, a: u32, b: u32) -> (u32, Met) {
        let (a, b) = (f32::from_bits(flushed(a)), f32::from_bits(flushed(b)));
        let sum = if self.toward_zero { toward::sum::<ZERO>(a, b) } else { a + b }.to_bits();
        (sum, Met::product(sum))
    }

    #[inline(always)]
    fn quick_mul<const FUSED: bool>(&self, a: u32, b: u32) -> (u32, Met) {
        let (x, y) = (flushed(a), flushed(b));
        let near = f32::from_bits(x) * f32::from_bits(y);
        let product = if self.toward_zero { cut_product::<FUSED>(x, y) } else { near }.to_bits();
        (if self.zero_wins & (is_zero(a) | is_zero(b)) { 0 } else { product }, Met::product(product))
    }

    /// The product of 24 bits and the sum are computed by the host.
    #[inline(always)]
    fn quick_mad<const FUSED: bool>(&self, a: u32, b: u32, c: u32) -> (u32, Met) {
        let (x, y, z) = (flushed(a), flushed(b), f32::from_bits(flushed(c)));
        let near = f32::from_bits(x) * f32::from_bits(y);
        let product = if is_zero(c) { near } else { cut_product::<FUSED>(x, y) };
        let wins = self.zero_wins & (is_zero(a) | is_zero(b));
        let sum = (if wins { 0.0 } else { product } + z).to_bits();
        (sum, Met::product(product.to_bits()).and(Met::product(sum)))
    }

    #[inline(always)]
    fn quick_dot<const FUSED: bool, const N: usize>(&self, a: [u32; N], b: [u32; N]) -> (u32, Met) {
        let (mut sum, mut met) = self.quick_mul::<FUSED>(a[0], b[0]);
        for k in 1..N {
            let (next, of_next) = self.quick_mad::<FUSED>(a[k], b[k], sum);
            (sum, met) = (next, met.and(of_next));
        }
        (sum, met)
    }

    #[inline(always)]
    fn unordered(&self, a: u32, b: u32) -> bool {
        is_nan(a) | is_nan(b)
    }

    #[inline(always)]
    fn below(&self, a: u32, b: u32) -> bool {
        f32::from_bits(flushed(a)) < f32::from_bits(flushed(b))
    }

    #[inline(always)]
    fn same(&self, a: u32, b: u32) -> bool {
        f32::from_bits(flushed(a)) == f32::from_bits(flushed(b))
    }

    #[inline(always)]
    fn min(&self, a: u32, b: u32) -> u32 {
        Self::choose(a, b, 0)
    }

    #[inline(always)]
    fn max(&self, a: u32, b: u32) -> u32 {
        Self::choose(a, b, u32::MAX)
    }

    #[inline(always)]
    fn floor(&self, x: u32) -> u32 {
        word(f32::from_bits(flushed(x)).floor())
    }

    #[inline(always)]
    fn saturate(&self, x: u32) -> u32 {
        let positive = if x & SIGN == 0 { flushed(x).min(ONE) } else { 0 };
        if is_nan(x) { NAN } else { positive }
    }
}
