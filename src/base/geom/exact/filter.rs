//! Ray-triangle tests in f64 with a proved error bound: each test returns a certain answer or no answer.
//!
//! **Why nothing overflows or underflows.** A finite f32 is a multiple of 2^-149 below 2^128. A difference of two is a
//! multiple of 2^-149 below 2^129, even after it is rounded to f64 (rounding a multiple of 2^-k, far above the least
//! normal number, gives a multiple of 2^-k). Products of three such values are multiples of 2^-447 below 2^387, sums of
//! six stay below 2^391; quotients lie between 2^-838 and 2^838. All these values are far inside the normal range of
//! f64, so every operation has a relative error of at most u = 2^-53, and a computed zero is a true zero.
//!
//! **The bound.** Every value here is a sum of at most six products `x * y * z` whose factors are components of d
//! (exact) or differences of corners and origin (one rounding each). A product has at most eight roundings: three of
//! its factors, two of multiplications, one of the difference inside the cross product, and two of the outer sum. So
//! the error is at most ((1 + u)^8 - 1) * P with P the sum of the products' magnitudes. P is computed as P' by the same
//! operations on magnitudes, so P <= P' / (1 - u)^8, and the error is below 8.1 u P'. `16 u P'` is used (a power of two
//! times P', hence exact).

use std::cmp::Ordering;

use glam::{DVec3, Vec3Swizzles};

use super::hit::Sides;
use crate::geom::Ray;
use crate::geom::vector::wide;

/// Half a unit in the last place of 1: the largest relative error of one f64 operation.
const U: f64 = f64::EPSILON / 2.0;

/// Result of the f64 test of a ray and a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Guess {
    /// Certainly no hit.
    Miss,
    /// Certainly a hit, with the exact t within the bounds.
    Hit {
        /// Lower bound of t.
        low: f64,
        /// Upper bound of t.
        high: f64,
    },
    /// Uncertain: the error bound does not decide.
    Unclear,
}

#[derive(Clone, Copy)]
struct Estimate {
    value: f64,
    error: f64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Sense {
    Negative,
    Zero,
    Positive,
    Unknown,
}

impl Estimate {
    fn sense(self) -> Sense {
        if self.value > self.error {
            Sense::Positive
        } else if self.value < -self.error {
            Sense::Negative
        } else if self.error == 0.0 {
            Sense::Zero
        } else {
            Sense::Unknown
        }
    }
}

/// Cross product, and the sums of the magnitudes of its products.
fn cross(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let (left, right) = (a.yzx() * b.zxy(), a.zxy() * b.yzx());
    (left - right, left.abs() + right.abs())
}

/// Inner product of a vector and the result of [`cross`], with its error bound.
fn mixed(d: DVec3, (value, magnitude): (DVec3, DVec3)) -> Estimate {
    Estimate { value: d.dot(value), error: 16.0 * U * d.abs().dot(magnitude) }
}

/// Lower bound for every number that rounds to `t` in up to eight roundings.
pub(super) fn below(t: f64) -> f64 {
    t * (1.0 - 16.0 * U)
}

/// Upper bound for every number that rounds to `t` in up to eight roundings.
pub(super) fn above(t: f64) -> f64 {
    t * (1.0 + 16.0 * U)
}

/// Tests a ray and a triangle in f64. The corners must be finite.
pub fn guess(ray: &Ray, triangle: &[[f32; 3]; 3], sides: Sides) -> Guess {
    let (o, d) = (wide(ray.origin()), wide(ray.direction()));
    let [a, b, c] = triangle.map(|corner| wide(corner) - o);

    let edges = [cross(b, c), cross(c, a), cross(a, b)].map(|pair| mixed(d, pair).sense());
    let positive = edges.contains(&Sense::Positive);
    let negative = edges.contains(&Sense::Negative);
    if positive && (negative || sides == Sides::Front) {
        return Guess::Miss;
    }
    // Edges are differences of the triangle's own corners, not of corners relative to the origin: one rounding per
    // component.
    let corners = triangle.map(wide);
    let normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    let facing = mixed(d, normal);
    let height = mixed(a, normal);
    let sense = facing.sense();
    match sense {
        Sense::Zero => return Guess::Miss,
        Sense::Positive if negative || sides == Sides::Front => return Guess::Miss,
        Sense::Negative if positive => return Guess::Miss,
        _ => {}
    }
    match (sense, height.sense()) {
        (Sense::Positive, Sense::Negative) | (Sense::Negative, Sense::Positive) => return Guess::Miss,
        (Sense::Unknown, _) | (_, Sense::Unknown) => return Guess::Unclear,
        _ => {}
    }
    if edges.contains(&Sense::Unknown) {
        return Guess::Unclear;
    }
    // The signs of numerator and denominator are certain, so |value| > error, unless the height, and so t, is exactly
    // zero.
    let low = (height.value.abs() - height.error) / (facing.value.abs() + facing.error);
    let high = (height.value.abs() + height.error) / (facing.value.abs() - facing.error);
    Guess::Hit { low: below(low), high: above(high) }
}

pub(super) fn has_area(triangle: &[[f32; 3]; 3]) -> bool {
    let [a, b, c] = triangle.map(wide);
    let (value, magnitude) = cross(b - a, c - a);
    value.abs().cmpgt(16.0 * U * magnitude).any()
}

/// Returns the sign of a polygon's area in the plane; `None` if it is uncertain.
pub(super) fn winding(corners: &[[f32; 2]]) -> Option<Ordering> {
    let [first, rest @ ..] = corners else { return Some(Ordering::Equal) };
    let from_first = |corner: &[f32; 2]| [0, 1].map(|axis| f64::from(corner[axis]) - f64::from(first[axis]));
    let (mut value, mut magnitude) = (0.0, 0.0);
    for pair in rest.windows(2) {
        let [[ax, ay], [bx, by]] = [from_first(&pair[0]), from_first(&pair[1])];
        value += ax * by - ay * bx;
        magnitude += (ax * by).abs() + (ay * bx).abs();
    }
    // A product has four roundings, and at most one more per corner, from the sum.
    let error = (corners.len() as f64 + 8.0) * 2.0 * U * magnitude;
    match (Estimate { value, error }).sense() {
        Sense::Negative => Some(Ordering::Less),
        Sense::Zero => Some(Ordering::Equal),
        Sense::Positive => Some(Ordering::Greater),
        Sense::Unknown => None,
    }
}
