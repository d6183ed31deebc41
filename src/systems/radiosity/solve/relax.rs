//! Relaxation methods: Jacobi, Gauss-Seidel, successive over-relaxation.

use super::problem::{IterationHistory, Options, Problem, Solution, residual, start};
use crate::error::InputError;
use crate::linalg::dot;

/// Jacobi, equation 4. A step divides the residual by the diagonal, so the history costs no further product.
pub(super) fn jacobi(problem: &Problem<'_>, options: &Options) -> Result<Solution, InputError> {
    let (mut b, diagonal) = (start(problem), problem.matrix.diagonal());
    let mut history = IterationHistory::new(problem, options);
    loop {
        let left = residual(problem.matrix, problem.right_hand_side, &b);
        if let Some(converged) = history.note(&left)? {
            return Ok(history.into_solution(b, converged));
        }
        for ((b, r), d) in b.iter_mut().zip(&left).zip(&diagonal) {
            *b += r / d;
        }
    }
}

/// Gauss-Seidel with relaxation factor `factor`. The history costs one product per sweep.
pub(super) fn gauss_seidel(problem: &Problem<'_>, factor: f64, options: &Options) -> Result<Solution, InputError> {
    let (mut b, diagonal) = (start(problem), problem.matrix.diagonal());
    let mut history = IterationHistory::new(problem, options);
    loop {
        if let Some(converged) = history.note(&residual(problem.matrix, problem.right_hand_side, &b))? {
            return Ok(history.into_solution(b, converged));
        }
        for (i, row) in problem.matrix.rows().enumerate() {
            b[i] += factor * (problem.right_hand_side[i] - dot(row, &b)) / diagonal[i];
        }
    }
}
