//! The truth that iterations are held against.

use super::{Options, Problem, Progress, Solution, SolveError, residual, start};
use crate::linalg::Lu;

/// One "iteration". The tolerance decides only whether it is called converged.
pub(super) fn solve(problem: &Problem<'_>, options: &Options) -> Result<Solution, SolveError> {
    let radiosity = Lu::new(problem.matrix)?.solve(problem.right);
    let mut progress = Progress::new(problem, options);
    progress.note(&residual(problem.matrix, problem.right, &start(problem)))?;
    let left = residual(problem.matrix, problem.right, &radiosity);
    progress.note(&left)?;
    let converged = progress.history.last().is_some_and(|&error| error <= progress.target);
    Ok(progress.into_solution(radiosity, converged))
}
