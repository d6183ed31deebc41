//! Reference solution by LU.

use super::problem::{IterationHistory, Options, Problem, Solution, residual, start};
use crate::error::InputError;
use crate::linalg::Lu;

/// Solves by LU. Counts as one iteration; the tolerance only decides whether the solution counts as converged.
pub(super) fn solve(problem: &Problem<'_>, options: &Options) -> Result<Solution, InputError> {
    let radiosity =
        Lu::new(problem.matrix).map_err(|error| error.coded("radiosity::solve"))?.solve(problem.right_hand_side);
    let mut history = IterationHistory::new(problem, options);
    history.note(&residual(problem.matrix, problem.right_hand_side, &start(problem)))?;
    let left = residual(problem.matrix, problem.right_hand_side, &radiosity);
    history.note(&left)?;
    let converged = history.errors.last().is_some_and(|&error| error <= history.target);
    Ok(history.into_solution(radiosity, converged))
}
