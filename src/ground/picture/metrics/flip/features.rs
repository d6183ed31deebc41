//! Edge and point detection: first and second derivatives of the lightness.

use super::super::filter::{PixelPlane, normalized, taps};
use crate::elementary::exp;

/// Width of the features that the eye detects, in degrees.
const FEATURE_WIDTH: f64 = 0.082;

/// Strength of edges and of points in each pixel.
pub(super) struct Features {
    edges: Vec<f64>,
    points: Vec<f64>,
}

impl Features {
    /// Detects the features of a lightness in [0, 1].
    pub(super) fn of(lightness: &PixelPlane, ppd: f64) -> Self {
        let deviation = 0.5 * FEATURE_WIDTH * ppd;
        let radius = (3.0 * deviation).ceil() as u32;
        let gaussian = |x: f64| exp(-x * x / (2.0 * deviation * deviation));
        let across = normalized(&taps(radius, gaussian));
        let strength = |derivative: Vec<f64>| {
            let [x, y] = [(&derivative, &across), (&across, &derivative)]
                .map(|(along_rows, along_columns)| lightness.filtered(along_rows, along_columns).values);
            x.iter().zip(&y).map(|(x, y)| (x * x + y * y).sqrt()).collect()
        };
        Self {
            edges: strength(balanced(&taps(radius, |x| -x * gaussian(x)))),
            points: strength(balanced(&taps(radius, |x| (x * x / (deviation * deviation) - 1.0) * gaussian(x)))),
        }
    }

    /// Larger of the differences of edges and points at a pixel.
    pub(super) fn difference(&self, other: &Self, at: usize) -> f64 {
        (self.edges[at] - other.edges[at]).abs().max((self.points[at] - other.points[at]).abs())
    }
}

/// Scales weights so that the positive part sums to 1 and the negative part to -1.
fn balanced(weights: &[f64]) -> Vec<f64> {
    let sum = |sign: f64| weights.iter().map(|weight| (sign * weight).max(0.0)).sum::<f64>();
    let (above, below) = (sum(1.0), sum(-1.0));
    weights.iter().map(|&weight| if weight > 0.0 { weight / above } else { weight / below }).collect()
}
