//! Progressive refinement (Cohen, Chen, Wallace and Greenberg, 1988): Southwell's relaxation, largest power first.

use super::problem::{IterationHistory, Options, Problem, Solution, residual, start};
use crate::error::InputError;

/// The residual is the unshot radiosity. An iteration is as many shots as there are patches; then the residual is
/// computed anew, so that rounding errors do not accumulate in it.
pub(super) fn shoot(problem: &Problem<'_>, options: &Options) -> Result<Solution, InputError> {
    let (mut b, diagonal) = (start(problem), problem.matrix.diagonal());
    // A shot reads a column of the matrix.
    let columns = problem.matrix.transposed();
    let mut history = IterationHistory::new(problem, options);
    loop {
        let mut unshot = residual(problem.matrix, problem.right_hand_side, &b);
        if let Some(converged) = history.note(&unshot)? {
            return Ok(history.into_solution(b, converged));
        }
        for _ in 0..b.len() {
            let i = brightest(&unshot, problem.areas);
            let shot = unshot[i] / diagonal[i];
            b[i] += shot;
            for (left, m) in unshot.iter_mut().zip(columns.row(i)) {
                *left -= shot * m;
            }
            unshot[i] = 0.0;
        }
    }
}

/// The patch with the most unshot power, the first of equals.
fn brightest(unshot: &[f64], areas: &[f64]) -> usize {
    let (mut best, mut at) = (-1.0, 0);
    for (i, (left, area)) in unshot.iter().zip(areas).enumerate() {
        let power = left.abs() * area;
        if power > best {
            (best, at) = (power, i);
        }
    }
    at
}
