//! Sums, products and reciprocals of single precision in the roundings that the host does not have: the host's own,
//! moved by one unit where its error has the wrong sign.
//!
//! Truncating twice, to 24 bits and then to fewer, is truncating once, and so is rounding down twice; and rounding to
//! nearest away sees the same halves after a truncation. So these serve every format of up to 24 bits. A finite result
//! that is too large for single precision is infinite here, in every rounding.

use super::round::DOWN;

const SIGN: u32 = 1 << 31;
/// The pattern of -infinity as an integer: negative finite numbers, `-0` among them, lie below.
const INFINITE: i32 = 0xff80_0000_u32.cast_signed();
/// Products from here on have an error that is a number of single precision.
const TINY: f32 = f32::from_bits((127 - 100) << 23);

/// `a + b` cut off or, for [`DOWN`], rounded down.
#[inline(always)]
pub(crate) fn sum<const R: u8>(a: f32, b: f32) -> f32 {
    let (s, e) = sum_and_error(a, b);
    if R != DOWN {
        // Negative where the sum is too large; one less than `-0`, which is no error, is a positive integer.
        let inward = e.to_bits() ^ s.to_bits() & SIGN;
        let too_large = inward.wrapping_sub(1).cast_signed() < INFINITE - 1;
        return f32::from_bits(s.to_bits().wrapping_sub(too_large.into()));
    }
    let too_large = e.to_bits().wrapping_sub(1).cast_signed() < INFINITE - 1;
    let lower = one_lower(s, too_large);
    // What cancels is -0, unless both are +0.
    if s == 0.0 { f32::from_bits((a.to_bits() | b.to_bits()) & SIGN) } else { lower }
}

/// `a + b` cut off, of numbers of at most eleven bits: the sum is exact, unless the smaller operand is less than a
/// quarter of a unit of the larger one and rounds away.
#[inline(always)]
pub(crate) fn short_sum(a: f32, b: f32) -> f32 {
    let s = a + b;
    // Negative and finite where the signs differ and neither is zero or infinite.
    let opposite = (a * b).to_bits().wrapping_sub(1).cast_signed() < INFINITE - 1;
    let too_large = ((s == a) | (s == b)) & opposite;
    f32::from_bits(s.to_bits().wrapping_sub(too_large.into()))
}

/// `a b` cut off or, for [`DOWN`], rounded down.
///
/// The error of a product can be too small for single precision, but its sign is always right: a negative one is `-0`
/// at least, and no error is `+0`.
#[inline(always)]
pub(crate) fn product<const R: u8>(a: f32, b: f32) -> f32 {
    if R != DOWN {
        let sign = (a.to_bits() ^ b.to_bits()) & SIGN;
        let (a, b) = (a.abs(), b.abs());
        let p = a * b;
        let too_large = error(a, b, p).to_bits().cast_signed() < INFINITE;
        return f32::from_bits(p.to_bits().wrapping_sub(too_large.into()) | sign);
    }
    let p = a * b;
    one_lower(p, error(a, b, p).to_bits().cast_signed() < INFINITE)
}

/// `1 / x` cut off or, for [`DOWN`], rounded down; of zero an infinity of its sign.
///
/// The host's reciprocal times `x`, less 1, is a number of single precision: its sign says on which side of the truth
/// the reciprocal lies. No reciprocal but those of powers of two, which are exact, is half way between two singles, so
/// that rounding to nearest away is what the host does.
#[inline(always)]
pub(crate) fn reciprocal<const R: u8>(x: f32) -> f32 {
    let q = 1.0 / x;
    // Positive where `q` is too large in magnitude; infinite or NaN where it is an infinity, NaN where it is a zero.
    let excess = error(q, x, 1.0);
    let too_large = (excess > 0.0) & (excess < f32::INFINITY);
    let (inward, outward) =
        if R == DOWN { (too_large & (x > 0.0), (excess < 0.0) & (x < 0.0)) } else { (too_large, false) };
    f32::from_bits(q.to_bits().wrapping_sub(inward.into()).wrapping_add(outward.into()))
}

/// `a + b` rounded to the nearest single, ties away from zero.
#[inline(always)]
pub(crate) fn nearest_sum(a: f32, b: f32) -> f32 {
    let (s, e) = sum_and_error(a, b);
    tie_away(s, e)
}

/// `a b` rounded likewise; NaN where its error is too small for single precision.
#[inline(always)]
pub(crate) fn nearest_product(a: f32, b: f32) -> f32 {
    let p = a * b;
    let near = tie_away(p, error(a, b, p));
    if (p.abs() < TINY) & (a != 0.0) & (b != 0.0) { f32::NAN } else { near }
}

/// `a b - p`, rounded once.
#[inline(always)]
#[expect(
    clippy::disallowed_methods,
    reason = "fused on every host, in software where need be: its one rounding is wanted"
)]
fn error(a: f32, b: f32, p: f32) -> f32 {
    a.mul_add(b, -p)
}

/// The next number away from zero if the error is half the way to it; otherwise the number, which is the nearest then.
#[inline(always)]
fn tie_away(x: f32, error: f32) -> f32 {
    let next = f32::from_bits(x.to_bits().wrapping_add(1));
    if error + error == next - x { next } else { x }
}

/// The sum of the host, and its error `(a + b) - s` (Dekker's fast two-sum). An infinite sum of finite numbers leaves
/// -infinity times its sign, one of infinities NaN.
#[inline(always)]
fn sum_and_error(a: f32, b: f32) -> (f32, f32) {
    let s = a + b;
    let (large, small) = if a.abs() < b.abs() { (b, a) } else { (a, b) };
    (s, small - (s - large))
}

/// The next number toward -infinity, where told.
#[inline(always)]
fn one_lower(x: f32, lower: bool) -> f32 {
    let outward = (x.to_bits().cast_signed() >> 31 | 1).cast_unsigned();
    f32::from_bits(x.to_bits().wrapping_sub(if lower { outward } else { 0 }))
}
