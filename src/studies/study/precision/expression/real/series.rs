//! Enclosures of elementary functions at a dyadic point, by series in integers.
//!
//! Values are integers in units of `2^-places`, as in [`refsim::num::series`]. All functions work with [`GUARD`] more
//! bits than their result needs, and widen the result by `2^ERROR` units: a series has at most one term per bit, there
//! are fewer than `2^14` bits, and a term errs by at most eight units.

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::{One, Zero};
use refsim::num::series;

use super::dyadic::{Dyadic, End, LIMIT};
use super::interval::RealInterval;

/// Additional bits for intermediate results.
const GUARD: i64 = 40;
/// Bound on the error of a series, as a power of two in its units.
const ERROR: u32 = 22;
/// Largest magnitude of angles, as a power of two.
const MAX_ANGLE: i64 = 1 << 15;

/// pi, to about `bits` bits.
pub(super) fn pi(bits: u64) -> RealInterval {
    RealInterval::around(&series::pi(bits), 2, -bits.cast_signed())
}

/// ln 2, to about `bits` bits.
pub(super) fn ln_2(bits: u64) -> RealInterval {
    RealInterval::around(&series::ln_2(bits), 2, -bits.cast_signed())
}

fn enclosed(sum: &BigInt, places: i64) -> RealInterval {
    RealInterval::around(sum, 1 << ERROR, -places)
}

/// From `1 + low 2^exponent` to `1 + high 2^exponent`.
fn near_one(low: i32, high: i32, exponent: i64, bits: u64) -> RealInterval {
    let at = |x: i32, up| End::At(Dyadic::new(1, 0).plus(&Dyadic::new(x, exponent), bits, up));
    RealInterval { low: at(low, false), high: at(high, true) }
}

/// `e^x`.
pub(super) fn exp(x: &Dyadic, bits: u64) -> RealInterval {
    let top = x.top();
    if x.is_zero() {
        return RealInterval::integer(1);
    }
    if top > 58 {
        let far = Dyadic::new(1, if x.is_negative() { -LIMIT } else { LIMIT });
        return match x.is_negative() {
            true => RealInterval { low: End::At(Dyadic::new(0, 0)), high: End::At(far) },
            false => RealInterval { low: End::At(far), high: End::Above },
        };
    }
    if top < -bits.cast_signed() - 2 {
        // `exp x - 1` has the sign of x, and at most twice its magnitude.
        return if x.is_negative() { near_one(-1, 0, top, bits) } else { near_one(0, 1, top + 1, bits) };
    }
    let places = bits.cast_signed() + GUARD;
    // A multiple of ln 2 has an error of as many units as the multiple counts.
    let wide = places + top.max(0);
    let (whole, rest) = x.floor_at(wide).div_mod_floor(&series::ln_2(wide.unsigned_abs()));
    let sum = series::exp(&(rest >> (wide - places).unsigned_abs()), places.unsigned_abs());
    enclosed(&sum, places).scaled(i64::try_from(whole).unwrap_or(LIMIT))
}

/// `ln x` for `x` above zero.
pub(super) fn log(x: &Dyadic, bits: u64) -> RealInterval {
    // x = m 2^whole, with m between the roots of 1/2 and 2.
    let length = x.digits.bits().cast_signed();
    let is_small = (&x.digits * &x.digits).bits().cast_signed() < 2 * length;
    let unit = length - i64::from(is_small);
    let whole = x.exponent + unit;
    let one = BigInt::one() << unit.unsigned_abs();
    let less = &x.digits - &one;
    if less.is_zero() && whole == 0 {
        return RealInterval::integer(0);
    }
    let near = if whole == 0 { unit - less.bits().cast_signed() } else { 0 };
    let places = bits.cast_signed() + GUARD + near;
    let t: BigInt = (less << places.unsigned_abs()).div_floor(&(&x.digits + one));
    let square: BigInt = (&t * &t) >> places.unsigned_abs();
    let (mut power, mut sum, mut k) = (t, BigInt::zero(), 1u32);
    while !power.is_zero() && power != -BigInt::one() {
        sum += &power / k;
        power = (power * &square) >> places.unsigned_abs();
        k += 2;
    }
    // 64 more bits, because ln 2 is multiplied by a factor below 2^61.
    let shift: BigInt = (series::ln_2((places + 64).unsigned_abs()) * whole) >> 64u32;
    enclosed(&(sum * 2 + shift), places)
}

/// `atan x`.
pub(super) fn atan(x: &Dyadic, bits: u64) -> RealInterval {
    let (top, precision) = (x.top(), bits.cast_signed());
    if x.is_zero() {
        return RealInterval::integer(0);
    }
    if 2 * top < -precision - 4 {
        return below(x, bits);
    }
    let is_large = top > 0;
    let places = precision + GUARD + (-top).max(0);
    let magnitude = x.abs();
    let one = BigInt::one() << places.unsigned_abs();
    let mut y = match is_large {
        false => magnitude.floor_at(places),
        true if places < magnitude.exponent => BigInt::zero(),
        true => (BigInt::one() << (2 * places).unsigned_abs()) / magnitude.floor_at(places),
    };
    // atan y = 2 atan(y / (1 + sqrt(1 + y^2)))
    for _ in 0..4 {
        let root = ((BigInt::one() << (2 * places).unsigned_abs()) + &y * &y).sqrt();
        y = (y << places.unsigned_abs()) / (&one + root);
    }
    let square: BigInt = (&y * &y) >> places.unsigned_abs();
    let (mut power, mut sum, mut k) = (y, BigInt::zero(), 1u32);
    while !power.is_zero() {
        sum += &power / k;
        power = -((power * &square) >> places.unsigned_abs());
        k += 2;
    }
    let mut angle = sum << 4u32;
    if is_large {
        angle = (series::pi(places.unsigned_abs()) >> 1u32) - angle;
    }
    enclosed(&if x.is_negative() { -angle } else { angle }, places)
}

/// A function between `x (1 - x^2)` and `x`, for a small x.
fn below(x: &Dyadic, bits: u64) -> RealInterval {
    let less = near_one(-1, 0, 2 * x.top(), bits + 4);
    RealInterval::point(x.clone()).times(&less, bits)
}

/// `sin x` or `cos x`.
pub(super) fn circular(sine: bool, x: &Dyadic, bits: u64) -> RealInterval {
    let (top, precision) = (x.top(), bits.cast_signed());
    if x.is_zero() {
        return RealInterval::integer(i32::from(!sine));
    }
    if top > MAX_ANGLE {
        return RealInterval { low: End::At(Dyadic::new(-1, 0)), high: End::At(Dyadic::new(1, 0)) };
    }
    if 2 * top < -precision - 4 {
        return if sine { below(x, bits) } else { near_one(-1, 0, 2 * top, bits) };
    }
    let places = precision + GUARD + if sine { (-top).max(0) } else { 0 };
    let wide = places + top.max(0) + 4;
    enclosed(&series::circular(sine, &x.floor_at(wide), wide.unsigned_abs(), places.unsigned_abs()), places)
}
