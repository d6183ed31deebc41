//! Enforcement of reciprocity and closure.

use rayon::prelude::*;

use super::FormFactors;
use super::rows::divide;
use crate::error::{InputError, input_error};

/// Maximum number of rounds of scaling; each at least halves the logarithm of the remaining error.
const MAX_ROUNDS: u32 = 500;
/// Tolerance within which a row sum counts as 1.
const SCALED: f64 = 1e-13;

/// Statistics of the row sums.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowSums {
    /// The smallest sum.
    pub least: f64,
    /// The largest sum.
    pub most: f64,
    /// The fraction of the light leaving patches that leaves the room: 1 minus the area-weighted mean sum. Blind
    /// patches are excluded unless all are blind.
    pub escaping: f64,
    /// Number of patches that see no other patch, such as patches under a block.
    pub blind: usize,
}

impl FormFactors {
    /// The sum of each row: 1 for a patch whose light reaches only patches.
    pub fn row_sums(&self) -> Vec<f64> {
        self.matrix.times(&vec![1.0; self.len()])
    }

    /// Statistics of the row sums. All are zero if there are no patches.
    pub fn summary(&self) -> RowSums {
        let sums = self.row_sums();
        let fold = |start: f64, f: fn(f64, f64) -> f64| {
            if sums.is_empty() { 0.0 } else { sums.iter().copied().fold(start, f) }
        };
        let all_blind = sums.iter().all(|&sum| sum == 0.0);
        let counted = self.areas.iter().zip(&sums).filter(|&(_, &sum)| all_blind || sum > 0.0);
        let (area, leaving) = counted.fold((0.0, 0.0), |(a, l), (x, s)| (a + x, l + x * (1.0 - s)));
        RowSums {
            least: fold(f64::INFINITY, f64::min),
            most: fold(f64::NEG_INFINITY, f64::max),
            escaping: if area > 0.0 { leaving / area } else { 0.0 },
            blind: sums.iter().filter(|&&sum| sum == 0.0).count(),
        }
    }

    /// The patches that see no other patch, such as patches under a block.
    pub fn blind(&self) -> Vec<usize> {
        self.row_sums().into_iter().enumerate().filter(|&(_, sum)| sum == 0.0).map(|(patch, _)| patch).collect()
    }

    /// Enforces reciprocity: A_i F_ij and A_j F_ji become the mean of both.
    fn enforce_reciprocity(&mut self) {
        let n = self.len();
        for i in 0..n {
            for j in i + 1..n {
                let (a, b) = (self.areas[i], self.areas[j]);
                let mean = 0.5 * (a * self.matrix.row(i)[j] + b * self.matrix.row(j)[i]);
                self.matrix.row_mut(i)[j] = mean / a;
                self.matrix.row_mut(j)[i] = mean / b;
            }
        }
    }

    /// Enforces closure (every row sums to 1) and reciprocity: factors are scaled by d_i d_j, where d is found by the
    /// symmetric form of Sinkhorn and Knopp's iteration (1967). Zero rows stay unchanged. Fails with [`InputError`] if
    /// no such scaling exists or is found; the factors are then reciprocal, but not closed.
    pub fn enforce_closure(&mut self) -> Result<(), InputError> {
        self.enforce_reciprocity();
        let mut scale = vec![1.0; self.len()];
        let mut sums = Vec::new();
        for _ in 0..MAX_ROUNDS {
            sums = self.matrix.times(&scale);
            sums.iter_mut().zip(&scale).for_each(|(sum, d)| *sum = if *sum > 0.0 { *sum * d } else { 1.0 });
            if sums.iter().all(|sum| (sum - 1.0).abs() <= SCALED) {
                self.scale(&scale);
                return Ok(());
            }
            // Rows and columns share d, so each takes the square root of the correction.
            scale.iter_mut().zip(&sums).for_each(|(d, sum)| *d /= sum.sqrt());
        }
        let (patch, sum) = farthest(&sums);
        Err(input_error!("radiosity::form_factors" =>
            "form factors cannot be scaled to a closed room: after {MAX_ROUNDS} rounds patch {patch} (counted from \
             0) still sums to {sum}"))
    }

    /// Scales F_ij to d_i F_ij d_j. The result is reciprocal to one ULP.
    fn scale(&mut self, scale: &[f64]) {
        let areas = &self.areas;
        self.matrix.par_rows_mut().enumerate().for_each(|(i, row)| {
            for (value, d) in row.iter_mut().zip(scale).skip(i) {
                *value = *value * areas[i] * (scale[i] * d);
            }
        });
        divide(&mut self.matrix, areas);
    }
}

/// The row whose sum is farthest from 1 (on ties, the first), and its sum; zeros if there are no rows.
fn farthest(sums: &[f64]) -> (usize, f64) {
    let off = |sum: f64| if sum.is_nan() { f64::INFINITY } else { (sum - 1.0).abs() };
    let start = (0, sums.first().copied().unwrap_or(0.0));
    sums.iter().copied().enumerate().fold(start, |best, here| if off(here.1) > off(best.1) { here } else { best })
}
