//! The exchange of two polygons that lie in front of each other, by contour integrals (Stokes' theorem, twice):
//!
//! `A F = 1 / (2 pi) sum over sides a, b of (a . b) integral integral ln r`, with unit directions a and b of the sides.
//!
//! One of the two integrals has a closed form; the other uses eight Gauss points. For sides on the same line, where the
//! logarithm has its pole, both integrals are in closed form. See docs/papers/radiosity.md for the error.

use std::f64::consts::PI;

use crate::elementary::{atan2, ln};
use crate::geom::vector::unit;
use crate::quadrature::EIGHT;
use glam::DVec3;

/// Cosine between sides below which they contribute nothing.
const ACROSS: f64 = 1e-14;
/// Maximum distance at which sides count as on the same line, relative to their length.
const ON_LINE: f64 = 1e-9;

#[derive(Clone, Copy, Debug)]
struct BoundaryEdge {
    start: DVec3,
    direction: DVec3,
    length: f64,
}

/// Area of the first polygon times its form factor to the second. Corners run counter-clockwise seen from the front,
/// and each polygon lies wholly in front of the other's plane.
pub(super) fn exchange(one: &[DVec3], other: &[DVec3]) -> f64 {
    let others: Vec<BoundaryEdge> = sides(other).collect();
    let mut sum = 0.0;
    for a in sides(one) {
        for b in &others {
            let along = a.direction.dot(b.direction);
            if along.abs() > ACROSS {
                sum += along * logarithm_between(&a, b);
            }
        }
    }
    sum / (2.0 * PI)
}

fn sides(polygon: &[DVec3]) -> impl Iterator<Item = BoundaryEdge> + '_ {
    (0..polygon.len()).filter_map(|i| {
        let (start, end) = (polygon[i], polygon[(i + 1) % polygon.len()]);
        let vector = end - start;
        Some(BoundaryEdge { start, direction: unit(vector)?, length: vector.length() })
    })
}

/// The integral of ln r over both sides.
fn logarithm_between(a: &BoundaryEdge, b: &BoundaryEdge) -> f64 {
    let (near, far) = (a.seen_from(b.start), a.seen_from(b.end()));
    let off = ON_LINE * a.length.max(b.length);
    if near[1] <= off && far[1] <= off {
        // The integral does not depend on the direction of b.
        return on_one_line(a.length, near[0].min(far[0]), near[0].max(far[0]));
    }
    let inner = |t: f64| {
        let [along, away] = a.seen_from(b.at(t));
        from_point(a.length - along, away) - from_point(-along, away)
    };
    let sum = |value: &dyn Fn(f64) -> f64| EIGHT.iter().map(|&(t, weight)| weight * value(t)).sum::<f64>();
    // Near a common corner the inner integral varies like s ln s; points are denser there, so eight suffice.
    b.length
        * match [near, far].map(|[along, away]| away <= off && along >= -off && along <= a.length + off) {
            [true, _] => sum(&|t| 2.0 * t * inner(t * t)),
            [_, true] => sum(&|t| 2.0 * t * inner(1.0 - t * t)),
            _ => sum(&inner),
        }
}

impl BoundaryEdge {
    fn at(&self, t: f64) -> DVec3 {
        self.start + t * self.length * self.direction
    }

    fn end(&self) -> DVec3 {
        self.at(1.0)
    }

    /// A point's distance along the line from the start, and its distance from the line.
    fn seen_from(&self, point: DVec3) -> [f64; 2] {
        let to = point - self.start;
        let along = to.dot(self.direction);
        [along, (to - along * self.direction).length()]
    }
}

/// The integral of `ln sqrt(u^2 + away^2)` from 0 to u.
fn from_point(u: f64, away: f64) -> f64 {
    let square = u * u + away * away;
    if square == 0.0 { 0.0 } else { 0.5 * u * ln(square) - u + away * atan2(u, away) }
}

/// The integral of `ln |s - t|` for s from 0 to `length` and t from `t0` to `t1`.
fn on_one_line(length: f64, t0: f64, t1: f64) -> f64 {
    (twice(t1) - twice(t1 - length)) - (twice(t0) - twice(t0 - length))
}

/// A second antiderivative of `ln |u|`.
fn twice(u: f64) -> f64 {
    if u == 0.0 { 0.0 } else { u * u * (0.5 * ln(u.abs()) - 0.75) }
}
