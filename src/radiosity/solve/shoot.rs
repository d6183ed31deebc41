//! Progressive refinement (Cohen, Chen, Wallace and Greenberg, 1988): Southwell's relaxation, picked by power.

use super::{Options, Problem, Progress, Solution, SolveError, residual, start};

/// The residual is the light not yet sent on. As many shots as patches make an iteration; then the residual is computed afresh, so that
/// rounding does not gather in it.
pub(super) fn shoot(problem: &Problem<'_>, options: &Options) -> Result<Solution, SolveError> {
    let (mut b, diagonal) = (start(problem), problem.matrix.diagonal());
    // A shot needs a column.
    let columns = problem.matrix.transposed();
    let mut progress = Progress::new(problem, options);
    loop {
        let mut unshot = residual(problem.matrix, problem.right, &b);
        if let Some(converged) = progress.note(&unshot)? {
            return Ok(progress.into_solution(b, converged));
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

/// The patch with the most power to send on, the first of equals.
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
