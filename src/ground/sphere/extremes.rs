//! Minimum and maximum of a function given by coefficients, to detect ringing.

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

/// Minimum and maximum of a function on the sphere, with their directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// Minimum; negative if the light rings.
    pub least: f64,
    /// Direction of the minimum.
    pub least_at: DVec3,
    /// Maximum.
    pub largest: f64,
    /// Direction of the maximum.
    pub largest_at: DVec3,
}

impl Extremes {
    /// Finds the extremes of the function with these coefficients, by local search from the best samples of a grid with
    /// a spacing of a sixth of the shortest wavelength.
    pub fn of(coefficients: &[f64]) -> Self {
        let order = order_of(coefficients);
        let grid = DirectionRule::sphere(6 * order);
        let values: Vec<f64> = grid.directions().iter().map(|&at| evaluate(coefficients, at)).collect();
        let [(largest, largest_at), (least, least_at)] = [1.0, -1.0].map(|sign| {
            let apart = PI / (2.0 * order as f64);
            let starts = peaks(grid.directions(), &values, sign, apart);
            let found = starts.into_iter().map(|start| climb(coefficients, sign, start, apart / 3.0));
            let best = found.reduce(|a, b| if sign * b.0 > sign * a.0 { b } else { a });
            best.unwrap_or((f64::NAN, DVec3::Z))
        });
        Self { least, least_at, largest, largest_at }
    }
}

/// Returns the best samples that are at least `apart` from each other.
fn peaks(directions: &[DVec3], values: &[f64], sign: f64, apart: f64) -> Vec<DVec3> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| (sign * values[b]).total_cmp(&(sign * values[a])).then(a.cmp(&b)));
    let mut starts: Vec<DVec3> = Vec::new();
    for index in order {
        if starts.len() < STARTS && starts.iter().all(|start| start.distance(directions[index]) > apart) {
            starts.push(directions[index]);
        }
    }
    starts
}

/// Climbs to a local maximum by Newton's method in the tangent plane, with finite differences, or along the gradient
/// where the function is not concave. A step that does not climb is halved.
fn climb(coefficients: &[f64], sign: f64, start: DVec3, mut longest: f64) -> (f64, DVec3) {
    let (mut value, mut at) = (sign * evaluate(coefficients, start), start);
    for _ in 0..MAX_STEPS {
        let u = at.any_orthonormal_vector();
        let w = at.cross(u);
        let there = |x: f64, y: f64| (at + x * u + y * w).normalize();
        let f = |x: f64, y: f64| sign * evaluate(coefficients, there(x * STENCIL, y * STENCIL));
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
        let better = sign * evaluate(coefficients, next);
        if better > value {
            (value, at) = (better, next);
        } else {
            longest = 0.5 * (scale * length).min(longest);
        }
    }
    (sign * value, at)
}
