//! Input and output of the solvers, with the convergence history that all of them keep.

use crate::error::{InputError, ensure};
use crate::linalg::Matrix;

/// Stopping criteria.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Tolerance: norm of the residual relative to the norm of the right-hand side.
    pub tolerance: f64,
    /// Maximum number of iterations.
    pub most_iterations: u32,
}

impl Default for Options {
    fn default() -> Self {
        Self { tolerance: 1e-6, most_iterations: 1000 }
    }
}

/// A linear system with the other inputs of solvers.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// M of equation 2. Its diagonal has no zero.
    pub matrix: &'a Matrix,
    /// The right-hand side, E.
    pub right_hand_side: &'a [f64],
    /// Areas of the patches, by which shooting weights radiosities.
    pub areas: &'a [f64],
}

/// A solution with its convergence history.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Radiosity of each patch, B.
    pub radiosity: Vec<f64>,
    /// The mean square of the residual E - M B, initially and after each iteration: Figure 3's error.
    pub history: Vec<f64>,
    /// `true` if the tolerance was reached.
    pub converged: bool,
}

impl Solution {
    /// Number of iterations done.
    pub fn iterations(&self) -> usize {
        self.history.len() - 1
    }
}

/// The mean squares of the residuals so far, and the stopping criterion.
pub(super) struct IterationHistory {
    pub(super) errors: Vec<f64>,
    pub(super) target: f64,
    max_iterations: u32,
}

impl IterationHistory {
    pub(super) fn new(problem: &Problem<'_>, options: &Options) -> Self {
        let target = options.tolerance * options.tolerance * mean_square(problem.right_hand_side);
        Self { errors: Vec::new(), target, max_iterations: options.most_iterations }
    }

    /// Records a residual. Returns `Some` if the iteration ends here: `true` if the tolerance is reached.
    pub(super) fn note(&mut self, residual: &[f64]) -> Result<Option<bool>, InputError> {
        let error = mean_square(residual);
        ensure!(error.is_finite(), "radiosity::solve" =>
            "expected an iteration that converges, found no finite residual after {} iterations", self.errors.len());
        self.errors.push(error);
        let converged = error <= self.target;
        Ok((converged || self.errors.len() > self.max_iterations as usize).then_some(converged))
    }

    pub(super) fn into_solution(self, radiosity: Vec<f64>, converged: bool) -> Solution {
        Solution { radiosity, history: self.errors, converged }
    }
}

/// Mean square; 0 if there are no values.
pub fn mean_square(values: &[f64]) -> f64 {
    crate::linalg::dot(values, values) / values.len().max(1) as f64
}

/// The residual, E - M B.
pub fn residual(matrix: &Matrix, right_hand_side: &[f64], radiosity: &[f64]) -> Vec<f64> {
    matrix.times(radiosity).iter().zip(right_hand_side).map(|(mb, e)| e - mb).collect()
}
