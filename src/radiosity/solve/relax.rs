//! Iterations that go through the rows: Jacobi, Gauss-Seidel, over-relaxation.

use super::{Options, Problem, Progress, Solution, SolveError, residual, start};
use crate::linalg::dot;

/// Equation 4; its residual is what the next step divides by the diagonal, so the history costs nothing.
pub(super) fn jacobi(problem: &Problem<'_>, options: &Options) -> Result<Solution, SolveError> {
    let (mut b, diagonal) = (start(problem), problem.matrix.diagonal());
    let mut progress = Progress::new(problem, options);
    loop {
        let left = residual(problem.matrix, problem.right, &b);
        if let Some(converged) = progress.note(&left)? {
            return Ok(progress.into_solution(b, converged));
        }
        for ((b, r), d) in b.iter_mut().zip(&left).zip(&diagonal) {
            *b += r / d;
        }
    }
}

/// Row by row, each from the newest values, each step `step` times as long. The history costs a product a sweep.
pub(super) fn gauss_seidel(problem: &Problem<'_>, step: f64, options: &Options) -> Result<Solution, SolveError> {
    let (mut b, diagonal) = (start(problem), problem.matrix.diagonal());
    let mut progress = Progress::new(problem, options);
    loop {
        if let Some(converged) = progress.note(&residual(problem.matrix, problem.right, &b))? {
            return Ok(progress.into_solution(b, converged));
        }
        for (i, row) in problem.matrix.rows().enumerate() {
            b[i] += step * (problem.right[i] - dot(row, &b)) / diagonal[i];
        }
    }
}
