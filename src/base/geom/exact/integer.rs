//! Ray-triangle tests in integers, without a filter.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_traits::Zero;

use super::hit::{ExactT, NearestHit, Sides};
use crate::geom::{Mesh, Ray};

type IntegerVector = [BigInt; 3];

/// Decomposes a finite f32 into `mantissa * 2^exponent`.
fn split(value: f32) -> (i64, i32) {
    let bits = value.to_bits();
    let field = (bits >> 23 & 0xff).cast_signed();
    let fraction = i64::from(bits & 0x7f_ffff);
    let (mantissa, exponent) = if field == 0 { (fraction, -149) } else { (fraction | 0x80_0000, field - 150) };
    (if bits >> 31 == 1 { -mantissa } else { mantissa }, exponent)
}

/// Smallest exponent among some numbers, zeros excluded: 2^exponent divides them all.
fn common_exponent<'a>(values: impl IntoIterator<Item = &'a f32>) -> i32 {
    let parts = values.into_iter().map(|&value| split(value));
    parts.filter(|&(mantissa, _)| mantissa != 0).map(|(_, exponent)| exponent).min().unwrap_or(0)
}

/// Computes `value / 2^exponent`, an integer.
pub(in crate::geom) fn whole(value: f32, exponent: i32) -> BigInt {
    let (mantissa, own) = split(value);
    if mantissa == 0 { BigInt::zero() } else { BigInt::from(mantissa) << (own - exponent).unsigned_abs() }
}

fn vector(values: [f32; 3], exponent: i32) -> IntegerVector {
    values.map(|value| whole(value, exponent))
}

fn sub(a: &IntegerVector, b: &IntegerVector) -> IntegerVector {
    [&a[0] - &b[0], &a[1] - &b[1], &a[2] - &b[2]]
}

fn cross(a: &IntegerVector, b: &IntegerVector) -> IntegerVector {
    [&a[1] * &b[2] - &a[2] * &b[1], &a[2] * &b[0] - &a[0] * &b[2], &a[0] * &b[1] - &a[1] * &b[0]]
}

fn dot(a: &IntegerVector, b: &IntegerVector) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// Intersects a ray with a triangle. The corners must be finite.
pub fn intersect(ray: &Ray, triangle: &[[f32; 3]; 3], sides: Sides) -> Option<ExactT> {
    let (origin, direction) = (ray.origin(), ray.direction());
    let place = common_exponent(triangle.iter().flatten().chain(&origin));
    let step = common_exponent(&direction);
    let o = vector(origin, place);
    let d = vector(direction, step);
    let [a, b, c] = triangle.map(|corner| sub(&vector(corner, place), &o));

    let normal = cross(&sub(&b, &a), &sub(&c, &a));
    let facing = dot(&normal, &d);
    let sense = facing.sign();
    if sense == Sign::NoSign || (sides == Sides::Front && sense == Sign::Plus) {
        return None;
    }
    let with_or_zero = |value: &BigInt| value.is_zero() || value.sign() == sense;
    for [from, to] in [[&b, &c], [&c, &a], [&a, &b]] {
        if !with_or_zero(&dot(&d, &cross(from, to))) {
            return None;
        }
    }
    let height = dot(&normal, &a);
    if !with_or_zero(&height) {
        return None;
    }
    // height is in units of 2^(3 place), facing in units of 2^(2 place + step).
    let (mut num, mut den) = (height.into_parts().1, facing.into_parts().1);
    let scale = place - step;
    if scale >= 0 {
        num <<= scale.unsigned_abs();
    } else {
        den <<= scale.unsigned_abs();
    }
    ExactT::new(num, den)
}

/// Returns the first hit among all triangles, without filter or tree: the reference for tests of the faster functions.
pub fn nearest(mesh: &Mesh, ray: &Ray, sides: Sides) -> Option<NearestHit> {
    let mut first: Option<NearestHit> = None;
    for (triangle, corners) in (0..).zip(mesh.iter_corners()) {
        let Some(t) = intersect(ray, &corners, sides) else { continue };
        match &mut first {
            Some(best) if t > best.t => {}
            Some(best) if t == best.t => best.ties.push(triangle),
            _ => first = Some(NearestHit { triangle, t, ties: vec![triangle] }),
        }
    }
    first
}

/// Returns `true` if n = 0.
pub fn is_degenerate(triangle: &[[f32; 3]; 3]) -> bool {
    let place = common_exponent(triangle.iter().flatten());
    let [a, b, c] = triangle.map(|corner| vector(corner, place));
    cross(&sub(&b, &a), &sub(&c, &a)).iter().all(Zero::is_zero)
}

/// Returns the sign of a polygon's area in the plane.
pub fn winding(corners: &[[f32; 2]]) -> Ordering {
    let place = common_exponent(corners.iter().flatten());
    let at = |corner: usize| corners[corner % corners.len()].map(|value| whole(value, place));
    let product = |corner: usize| {
        let [[ax, ay], [bx, by]] = [at(corner), at(corner + 1)];
        ax * by - ay * bx
    };
    (0..corners.len()).map(product).sum::<BigInt>().cmp(&BigInt::zero())
}
