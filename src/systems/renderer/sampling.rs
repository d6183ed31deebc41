//! Sampling: maps from pairs of numbers in [0, 1) to directions and points. All are standard inversions (Dutre, Global
//! Illumination Compendium).

use super::vector::turned;
use crate::elementary::{on_circle, pow};
use glam::DVec3;

/// Samples the unit disk, uniformly by area.
pub fn disk(u: [f64; 2]) -> [f64; 2] {
    let radius = u[0].sqrt();
    on_circle(u[1]).map(|x| radius * x)
}

/// Samples a direction about a unit normal with density cos / pi (Malley's method).
pub fn cosine(normal: DVec3, u: [f64; 2]) -> DVec3 {
    let [x, y] = disk(u);
    turned(DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt()), normal)
}

/// Samples a direction, uniformly over the sphere.
pub fn sphere(u: [f64; 2]) -> DVec3 {
    let z = 1.0 - 2.0 * u[0];
    let across = (1.0 - z * z).max(0.0).sqrt();
    let [x, y] = on_circle(u[1]);
    DVec3::new(across * x, across * y, z)
}

/// Samples a direction about a unit axis with density `(n + 1) / (2 pi) * cos^n`: Phong's lobe of exponent n.
pub fn lobe(axis: DVec3, exponent: f64, u: [f64; 2]) -> DVec3 {
    // 1 - u is never 0.
    let cosine = pow(1.0 - u[0], 1.0 / (exponent + 1.0));
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let [x, y] = on_circle(u[1]);
    turned(DVec3::new(sine * x, sine * y, cosine), axis)
}

/// Samples a triangle uniformly by area; returns barycentric coordinates.
pub fn triangle(u: [f64; 2]) -> DVec3 {
    let root = u[0].sqrt();
    DVec3::new(1.0 - root, root * (1.0 - u[1]), root * u[1])
}

/// Discrete distribution with probabilities proportional to weights.
#[derive(Clone, Debug, Default)]
pub struct DiscreteDistribution {
    /// Running sums of the weights.
    sums: Vec<f64>,
}

impl DiscreteDistribution {
    /// Creates a distribution from non-negative weights.
    pub fn new(weights: impl IntoIterator<Item = f64>) -> Self {
        let mut sum = 0.0;
        let sums = weights.into_iter().map(|weight| {
            sum += weight;
            sum
        });
        Self { sums: sums.collect() }
    }

    /// Sum of all weights; 0 if there are none.
    pub fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0)
    }

    /// Samples an entry by a number in [0, 1), with its probability; `None` if all weights are zero.
    pub fn draw(&self, u: f64) -> Option<(usize, f64)> {
        let total = self.total();
        if total <= 0.0 {
            return None;
        }
        let entry = self.sums.partition_point(|&sum| sum <= u * total).min(self.sums.len() - 1);
        Some((entry, self.chance(entry)))
    }

    /// Probability of an entry.
    pub fn chance(&self, entry: usize) -> f64 {
        let before = if entry == 0 { 0.0 } else { self.sums[entry - 1] };
        (self.sums[entry] - before) / self.total()
    }
}
