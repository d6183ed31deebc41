//! Sums, products and reciprocals of single precision in roundings that the host lacks: the host's nearest result,
//! moved by one unit where its error has the wrong sign.
//!
//! Truncating twice, to 24 bits and then to fewer, equals truncating once; so does rounding down twice. Rounding to
//! nearest away after a truncation finds the same ties. So these functions serve every format of up to 24 bits. A
//! finite sum or product that is too large for single precision is the largest number if truncated, and the host's
//! result if rounded to nearest; a reciprocal is infinite.

use super::round::{AWAY, DOWN};

const SIGN: u32 = 1 << 31;
/// The pattern of -infinity as an integer: negative finite numbers, `-0` among them, lie below, and every NaN above.
const INFINITE: i32 = 0xff80_0000_u32.cast_signed();
/// `2^-49`: a product times this is less than any last bit of the exact product.
const HAIR: f32 = f32::from_bits((127 - 49) << 23);

/// `a + b` truncated or, for [`DOWN`], rounded down.
#[inline(always)]
pub(crate) fn sum<const R: u8>(a: f32, b: f32) -> f32 {
    if R == DOWN {
        // Rounding is symmetric, and `-a - b` is `+0` where the sum cancels.
        let s = -(-a - b);
        return one_lower(s, is_above(s, a, b));
    }
    let s = a + b;
    let sign = s.to_bits() & SIGN;
    let [a, b] = [a, b].map(|x| f32::from_bits(x.to_bits() ^ sign));
    f32::from_bits(s.to_bits().wrapping_sub(is_above(s.abs(), a, b).into()))
}

/// Returns `true` if `s`, the single nearest to `a + b`, is larger than the sum, as infinity is for finite operands.
///
/// Let `|a| >= |b|`. Then `s - a` is a single, and compares with `b` as `s` does with `a + b`. The other difference may
/// be rounded, but not past the single `a`: it never makes `s` appear larger than it is.
#[inline(always)]
fn is_above(s: f32, a: f32, b: f32) -> bool {
    (s - a > b) | (s - b > a)
}

/// Returns a single that rounds by `R`, to at most eleven bits, as `a + b` does. The operands have at most eleven bits
/// and six exponent bits.
///
/// If the sum `s` of the host is not exact, the smaller operand is less than an eighth of a unit of `s` in the format.
/// Rounded to nearest, both `s` and the sum give the larger operand. Truncated, they can differ only if `s` is the
/// larger operand itself: no other multiple of a unit is near.
#[inline(always)]
pub(crate) fn short_sum<const R: u8>(a: f32, b: f32) -> f32 {
    if R == DOWN {
        return sum::<DOWN>(a, b);
    }
    let s = a + b;
    // Both products are equal if `s` is exact. If `s` is one of the operands, the right product is zero, and the left
    // product is negative if the other operand makes the sum smaller than `s`.
    let too_large = (R != AWAY) & (a * b < (s - a) * (s - b));
    f32::from_bits(s.to_bits().wrapping_sub(too_large.into()))
}

/// `a b` truncated or, for [`DOWN`], rounded down.
///
/// The error of a product can be too small for single precision, but its sign is always right: a negative error gives
/// at least `-0`, an exact product `+0`.
#[inline(always)]
pub(crate) fn product<const R: u8>(a: f32, b: f32) -> f32 {
    let p = a * b;
    if R == DOWN {
        return one_lower(p, error(a, b, p).to_bits().cast_signed() <= INFINITE);
    }
    // Computes with magnitudes: `a`, multiplied by the sign of the product, times `b` is positive.
    let a = f32::from_bits(a.to_bits() ^ p.to_bits() & SIGN);
    let too_large = error(a, b, p.abs()).to_bits().cast_signed() <= INFINITE;
    f32::from_bits(p.to_bits().wrapping_sub(too_large.into()))
}

/// `1 / x` truncated or, for [`DOWN`], rounded down; zero gives an infinity of its sign.
///
/// The host's reciprocal times `x`, less 1, is a number of single precision: its sign shows on which side of the exact
/// value the reciprocal lies. No reciprocal lies half way between two singles, so the host's result also rounds to
/// nearest away.
#[inline(always)]
pub(crate) fn reciprocal<const R: u8>(x: f32) -> f32 {
    let q = 1.0 / x;
    // Positive where `q` is too large in magnitude; infinite or NaN for an infinite `q`, NaN for a zero `q`.
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

/// `a b` rounded to the nearest single, ties away; NaN where the product is too small to be adjusted.
///
/// The product has 48 bits at most. If a number is moved away from zero by a nonzero amount less than its last bit
/// before it is rounded to nearest, ties are rounded away from zero, and all other results stay the same. The amount,
/// rounded if subnormal, is at most half of the last bit.
#[inline(always)]
pub(crate) fn nearest_product(a: f32, b: f32) -> f32 {
    let outward = a * b * HAIR;
    let near = multiply_add(a, b, outward);
    if (outward == 0.0) & (a != 0.0) & (b != 0.0) { f32::NAN } else { near }
}

/// `a b - p`, rounded once.
#[inline(always)]
fn error(a: f32, b: f32, p: f32) -> f32 {
    multiply_add(a, b, -p)
}

/// `a b + c`, rounded once.
#[inline(always)]
#[expect(clippy::disallowed_methods, reason = "fused on every host, if necessary in software: it must round once")]
fn multiply_add(a: f32, b: f32, c: f32) -> f32 {
    a.mul_add(b, c)
}

/// The next number away from zero if the error is half the distance to it; otherwise the number itself.
#[inline(always)]
fn tie_away(x: f32, error: f32) -> f32 {
    let next = f32::from_bits(x.to_bits().wrapping_add(1));
    if error + error == next - x { next } else { x }
}

/// The host's sum and its error (Knuth's two-sum, for operands in any order). The error is NaN if the sum is infinite,
/// and can be NaN if the sum was rounded outward and the second operand is the largest number.
#[inline(always)]
fn sum_and_error(a: f32, b: f32) -> (f32, f32) {
    let s = a + b;
    let part = s - a;
    (s, (a - (s - part)) + (b - part))
}

/// The next number toward -infinity, if `lower`.
#[inline(always)]
fn one_lower(x: f32, lower: bool) -> f32 {
    let outward = (x.to_bits().cast_signed() >> 31 | 1).cast_unsigned();
    f32::from_bits(x.to_bits().wrapping_sub(if lower { outward } else { 0 }))
}
