//! Form factors of rectangles in closed form: parallel, or at right angles. Both contour integrals of `contour` are
//! evaluated analytically, which leaves a sum over the corners of both rectangles.
//!
//! The corner sums cancel: between small distant patches, sixteen numbers of order 1 sum to the order of the product of
//! the areas. So each result comes with an error bound (docs/papers/radiosity.md derives it), and matrices are not
//! computed this way.

use std::f64::consts::PI;

use crate::elementary::{atan2, ln};

/// Interval: low end, high end.
pub type Interval = [f64; 2];

/// Number with an error bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    /// The computed number.
    pub value: f64,
    /// A bound on the absolute error.
    pub error: f64,
}

/// Bound on the number of roundings between the corners and the sum: 12 in a term, 16 in the sum; in units of 2^-53.
const ROUNDINGS: f64 = 28.0;

/// Form factor from the rectangle `one` (x and y intervals) at z = 0 to the rectangle `other` at height `apart`, above
/// 0.
pub fn parallel(one: [Interval; 2], other: [Interval; 2], apart: f64) -> Bounded {
    let part = |u: f64, v: f64| {
        let away = (v * v + apart * apart).sqrt();
        u * away * atan2(u, away)
    };
    corner_sum(one, other, |x, y, x2, y2| {
        let (u, v) = (x - x2, y - y2);
        let before = 0.5 * apart * apart;
        ([part(u, v), part(v, u), -before * ln(u * u + v * v + apart * apart)], before)
    })
}

/// Form factor between rectangles at right angles, whose planes meet in the y axis. The first rectangle extends over
/// `out` (distance from the axis) and `y`, the second over `up` and `y2`; `out` and `up` may begin at 0.
pub fn perpendicular([out, y]: [Interval; 2], [up, y2]: [Interval; 2]) -> Bounded {
    corner_sum([out, y], [up, y2], |x, y, z, y2| {
        let (square, v) = (x * x + z * z, y - y2);
        let away = square.sqrt();
        let all = square + v * v;
        let logarithm = if all > 0.0 { 0.25 * ln(all) } else { 0.0 };
        ([v * away * atan2(v, away), -square * logarithm, v * v * logarithm], 0.25 * all)
    })
}

/// Signed sum of a corner function over all corners, divided by 2 pi and the area of the first rectangle, with a bound
/// on the rounding error. The function returns its terms and the factor of its logarithm, because the rounding error of
/// a logarithm near 0 is not proportional to its value.
fn corner_sum(
    one: [Interval; 2],
    other: [Interval; 2],
    terms: impl Fn(f64, f64, f64, f64) -> ([f64; 3], f64),
) -> Bounded {
    let (mut sum, mut size) = (0.0, 0.0);
    for corner in 0..16_usize {
        let pick = |interval: Interval, bit: usize| interval[corner >> bit & 1];
        let (found, before) = terms(pick(one[0], 0), pick(one[1], 1), pick(other[0], 2), pick(other[1], 3));
        let [a, b, c] = if corner.count_ones() % 2 == 0 { found } else { found.map(|term| -term) };
        sum += a + b + c;
        size += a.abs() + b.abs() + c.abs() + before;
    }
    let area = (one[0][1] - one[0][0]) * (one[1][1] - one[1][0]);
    let unit = 0.5 * f64::EPSILON;
    Bounded { value: sum / (2.0 * PI * area), error: ROUNDINGS * unit * size / (2.0 * PI * area) }
}
