//! Sampling: maps from pairs of numbers in [0, 1) to directions and points. All are the standard inversions (Dutre,
//! Global Illumination Compendium).

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

    /// Sum of all weights; 0 for none.
    pub fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0)
    }

    /// Samples an entry by a number in [0, 1); returns it and its probability, or `None` if all weights are zero.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::random::CounterRng;
    use approx::assert_abs_diff_eq;

    const COUNT: u64 = 20_000;

    fn mean(f: impl Fn([f64; 2]) -> f64) -> f64 {
        let random = CounterRng::new(5);
        (0..COUNT).map(|i| f([random.unit(i, 0, 0), random.unit(i, 0, 1)])).sum::<f64>() / COUNT as f64
    }

    #[test]
    fn densities_are_those_stated() {
        let normal = DVec3::new(0.0, 0.6, 0.8);
        // Under cos / pi the mean cosine is 2/3; under the lobe's density it is (n + 1) / (n + 2).
        assert_abs_diff_eq!(mean(|u| cosine(normal, u).dot(normal)), 2.0 / 3.0, epsilon = 0.01);
        assert_abs_diff_eq!(mean(|u| lobe(normal, 8.0, u).dot(normal)), 0.9, epsilon = 0.005);
        // The centroid of a triangle is the mean of its corners; half of a disk's area lies within 1 / sqrt 2.
        assert_abs_diff_eq!(mean(|u| triangle(u)[1]), 1.0 / 3.0, epsilon = 0.01);
        assert_abs_diff_eq!(mean(|u| disk(u).map(|x| x * x).iter().sum::<f64>()), 0.5, epsilon = 0.01);
    }

    #[test]
    fn tables_pass_over_what_has_no_weight() {
        let table = DiscreteDistribution::new([0.0, 1.0, 0.0, 3.0, 0.0]);
        assert_eq!(table.draw(0.0), Some((1, 0.25)));
        assert_eq!(table.draw(0.2499), Some((1, 0.25)));
        assert_eq!(table.draw(0.25), Some((3, 0.75)));
        assert_eq!(table.draw(0.999), Some((3, 0.75)));
        assert_eq!(DiscreteDistribution::new([0.0]).draw(0.5), None);
    }
}
