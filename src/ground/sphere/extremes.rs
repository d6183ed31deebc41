//! Minimum and maximum of a function given by coefficients, to detect ringing.

use std::f64::consts::PI;

use glam::DVec3;

use super::harmonics::{evaluate, order_of};
use super::rule::DirectionRule;

/// Number of samples from which the search starts.
const STARTS: usize = 16;
/// Maximum number of steps of the search.
const MAX_STEPS: usize = 100;
/// Minimum step, in radians: far below the scale at which a smooth peak changes its value.
const SHORTEST_STEP: f64 = 1e-10;
/// Step of finite differences, in radians: the error is its square times third derivatives.
const STENCIL: f64 = 1e-4;

/// Minimum and maximum of a function on the sphere, with their directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// Minimum: negative where light rings.
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
    ///
    /// # Panics
    /// If the number of coefficients is not a square of 1 to 10.
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

/// Returns the best samples at least a distance apart.
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

/// Climbs to a local maximum by Newton's method in the tangent plane, with finite differences; along the gradient where
/// the surface is not concave. A step that does not climb is halved.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sphere::{function_count, function_index, harmonics};

    #[test]
    fn a_linear_function_is_largest_along_its_vector() {
        let Extremes { least, least_at, largest, largest_at } = Extremes::of(&[2.0, 2.0, 3.0, 6.0]);
        let direction = DVec3::new(6.0, 2.0, 3.0) / 7.0;
        assert!(largest_at.distance(direction) < 1e-7 && least_at.distance(-direction) < 1e-7);
        let [constant, linear] = [2.0 / (4.0 * PI).sqrt(), 7.0 * (3.0 / (4.0 * PI)).sqrt()];
        assert!((largest - constant - linear).abs() < 1e-14 && (least - constant + linear).abs() < 1e-14);
    }

    #[test]
    fn a_delta_is_largest_at_its_place() {
        for order in 1..=10 {
            let mut delta = vec![0.0; function_count(order)];
            let place = DVec3::new(1.0, -2.0, 2.0) / 3.0;
            harmonics(order, place, &mut delta);
            let found = Extremes::of(&delta);
            // The addition theorem: the square sum of harmonics is n^2 / (4 pi).
            let expected = (order * order) as f64 / (4.0 * PI);
            assert!((found.largest - expected).abs() < 1e-13 * expected, "{order}: {found:?}");
            assert!(order == 1 || found.largest_at.distance(place) < 1e-6, "{order}: {found:?}");
        }
        // P_2 = (3 z^2 - 1) / 2 is least on the equator.
        let mut zonal = [0.0; 9];
        zonal[function_index(2, 0)] = (4.0 * PI / 5.0).sqrt();
        let found = Extremes::of(&zonal);
        assert!((found.least + 0.5).abs() < 1e-15 && (found.largest - 1.0).abs() < 1e-15, "{found:?}");
    }
}
