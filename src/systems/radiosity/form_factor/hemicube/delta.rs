//! Delta form factors, one per pixel of a hemicube, in closed form.
//!
//! The fraction of a patch's light that leaves through a rectangle of the cube is the integral of a cosine over pi
//! over the rectangle's solid angle. Both kinds of face have an antiderivative at corners, so a pixel is a sum over
//! its four corners, and the sum over all pixels telescopes to 1.

use std::f64::consts::PI;

use crate::elementary::atan2;

/// The delta form factors of the five faces, rows from the top: the top face, then a side.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Deltas {
    /// Top face: `resolution` squared values.
    pub(super) top: Vec<f64>,
    /// A side face: half as many, the lowest row touching the patch's plane. The same for all four.
    pub(super) side: Vec<f64>,
}

impl Deltas {
    /// Computes the delta form factors for `resolution` pixels along a side of the top face, an even number.
    pub(super) fn new(resolution: u32) -> Self {
        let (across, half) = (f64::from(resolution), resolution / 2);
        let centered = |i: u32| 2.0 * f64::from(i) / across - 1.0;
        // Rows of a side face run from height 1 down to 0.
        let height = |j: u32| 1.0 - 2.0 * f64::from(j) / across;
        let mut top = Vec::new();
        for j in 0..resolution {
            top.extend((0..resolution).map(|i| {
                let [x, y] = [[centered(i), centered(i + 1)], [centered(j), centered(j + 1)]];
                corners(above, x, y)
            }));
        }
        let mut side = Vec::new();
        for j in 0..half {
            side.extend(
                (0..resolution).map(|i| corners(beside, [centered(i), centered(i + 1)], [height(j + 1), height(j)])),
            );
        }
        Self { top, side }
    }
}

/// The integral over a rectangle by an antiderivative at its corners.
fn corners(f: fn(f64, f64) -> f64, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> f64 {
    (f(x1, y1) - f(x0, y1)) - (f(x1, y0) - f(x0, y0))
}

/// The antiderivative of `1 / (pi (1 + x^2 + y^2)^2)` on the top face, at height 1.
fn above(x: f64, y: f64) -> f64 {
    let (a, b) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    (x / a * atan2(y, a) + y / b * atan2(x, b)) / (2.0 * PI)
}

/// The antiderivative of `z / (pi (1 + y^2 + z^2)^2)` on a side face, at distance 1: across it, and upwards.
fn beside(y: f64, z: f64) -> f64 {
    let c = (1.0 + z * z).sqrt();
    -atan2(y, c) / (2.0 * PI * c)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn pixels_sum_to_one_and_are_what_the_middle_says_of_small_ones() {
        for resolution in [2, 4, 16, 64, 256] {
            let Deltas { top, side } = Deltas::new(resolution);
            let (above, beside): (f64, f64) = (top.iter().sum(), side.iter().sum());
            // A corner is at most 1/4 and off by 8 roundings of it; each pixel adds four, the sum a rounding of at
            // most 1 a pixel.
            let pixels = 3.0 * f64::from(resolution * resolution);
            let tolerance = pixels * (8.0 + 1.0) * f64::EPSILON / 2.0;
            assert!((above + 4.0 * beside - 1.0).abs() <= tolerance, "{resolution}: {}", above + 4.0 * beside - 1.0);
            assert!(top.iter().chain(&side).all(|&delta| delta > 0.0), "{resolution}");
        }
        // Cohen and Greenberg's formulas at the pixel's middle.
        let (n, Deltas { top, side }) = (256_usize, Deltas::new(256));
        let at = |i: usize| (2 * i + 1) as f64 / n as f64 - 1.0;
        let area = 4.0 / (n * n) as f64;
        for (i, j) in [(0, 0), (128, 128), (40, 200), (255, 3)] {
            let r = 1.0 + at(i) * at(i) + at(j) * at(j);
            assert_abs_diff_eq!(top[j * n + i] / (area / (PI * r * r)), 1.0, epsilon = 1e-4);
        }
        for (i, j) in [(0, 0), (128, 127), (40, 100)] {
            let z = 1.0 - (2 * j + 1) as f64 / n as f64;
            let r = 1.0 + at(i) * at(i) + z * z;
            assert_abs_diff_eq!(side[j * n + i] / (z * area / (PI * r * r)), 1.0, epsilon = 1e-4);
        }
    }
}
