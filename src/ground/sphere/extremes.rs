//! Minimum of a function given by coefficients, to detect ringing.

use std::f64::consts::PI;

use glam::DVec3;

use super::harmonics::{evaluate, order_of};
use super::rule::DirectionRule;

/// Number of samples from which the search starts.
const STARTS: usize = 16;
const MAX_STEPS: usize = 100;
/// Minimum step, in radians; over such a step the value at a smooth peak does not change.
const SHORTEST_STEP: f64 = 1e-10;
/// Step of finite differences, in radians; the error is its square times third derivatives.
const STENCIL: f64 = 1e-4;

/// Finds the minimum of the function with these coefficients, and its direction, by local search from the lowest samples
/// of a grid with a spacing of a sixth of the shortest wavelength.
pub fn least(coefficients: &[f64]) -> (f64, DVec3) {
    let order = order_of(coefficients);
    let grid = DirectionRule::sphere(6 * order);
    let values: Vec<f64> = grid.directions().iter().map(|&at| evaluate(coefficients, at)).collect();
    let apart = PI / (2.0 * order as f64);
    let starts = lowest(grid.directions(), &values, apart);
    let found = starts.into_iter().map(|start| descend(coefficients, start, apart / 3.0));
    found.reduce(|a, b| if b.0 < a.0 { b } else { a }).unwrap_or((f64::NAN, DVec3::Z))
}

/// Returns the lowest samples that are at least `apart` from each other.
fn lowest(directions: &[DVec3], values: &[f64], apart: f64) -> Vec<DVec3> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]).then(a.cmp(&b)));
    let mut starts: Vec<DVec3> = Vec::new();
    for index in order {
        if starts.len() < STARTS && starts.iter().all(|start| start.distance(directions[index]) > apart) {
            starts.push(directions[index]);
        }
    }
    starts
}

/// Descends to a local minimum, a maximum of the negated function, by Newton's method in the tangent plane, with finite
/// differences, or along the gradient where the negated function is not concave. A step that does not climb is halved.
fn descend(coefficients: &[f64], start: DVec3, mut longest: f64) -> (f64, DVec3) {
    let negated = |at: DVec3| -evaluate(coefficients, at);
    let (mut value, mut at) = (negated(start), start);
    for _ in 0..MAX_STEPS {
        let u = at.any_orthonormal_vector();
        let w = at.cross(u);
        let there = |x: f64, y: f64| (at + x * u + y * w).normalize();
        let f = |x: f64, y: f64| negated(there(x * STENCIL, y * STENCIL));
        let [left, right, below, above] = [f(-1.0, 0.0), f(1.0, 0.0), f(0.0, -1.0), f(0.0, 1.0)];
        let gradient = [(right - left) / (2.0 * STENCIL), (above - below) / (2.0 * STENCIL)];
        let square = STENCIL * STENCIL;
        let [xx, yy] = [(left + right - 2.0 * value) / square, (below + above - 2.0 * value) / square];
        let xy = (f(1.0, 1.0) + f(-1.0, -1.0) - f(1.0, -1.0) - f(-1.0, 1.0)) / (4.0 * square);
        let [gx, gy] = gradient;
        let determinant = xx * yy - xy * xy;
        // Away from a peak Newton's step may lead to a saddle or a minimum.
        let peak = xx < 0.0 && determinant > 0.0;
        let [x, y] =
            if peak { [(xy * gy - yy * gx) / determinant, (xy * gx - xx * gy) / determinant] } else { gradient };
        let length = (x * x + y * y).sqrt();
        if length == 0.0 || longest < SHORTEST_STEP {
            break;
        }
        let scale = if peak && length <= longest { 1.0 } else { longest / length };
        let next = there(scale * x, scale * y);
        let better = negated(next);
        if better > value {
            (value, at) = (better, next);
        } else {
            longest = 0.5 * (scale * length).min(longest);
        }
    }
    (-value, at)
}
