//! The methods: Jacobi (equations 3 and 4), Gauss-Seidel with over-relaxation, shooting, LU.

use super::problem::{IterationHistory, Options, Problem, Solution, residual};
use crate::error::InputError;
use crate::linalg::{Lu, dot};

/// Repeats `step` from 0 until the stopping criterion holds. A step gets the radiosities and their residual.
fn iterate(
    problem: &Problem<'_>,
    options: &Options,
    mut step: impl FnMut(&mut [f64], Vec<f64>),
) -> Result<Solution, InputError> {
    let (mut b, mut history) = (vec![0.0; problem.matrix.row_count()], IterationHistory::new(problem, options));
    loop {
        let left = residual(problem.matrix, problem.right_hand_side, &b);
        if let Some(converged) = history.note(&left)? {
            return Ok(history.into_solution(b, converged));
        }
        step(&mut b, left);
    }
}

/// Jacobi, equation 4. A step divides the residual by the diagonal, so the history costs no additional product.
pub(super) fn jacobi(problem: &Problem<'_>, options: &Options) -> Result<Solution, InputError> {
    let diagonal = problem.matrix.diagonal();
    iterate(problem, options, |b, left| {
        b.iter_mut().zip(&left).zip(&diagonal).for_each(|((b, r), d)| *b += r / d);
    })
}

/// Gauss-Seidel with relaxation factor `factor`. The convergence history costs one product per sweep.
pub(super) fn gauss_seidel(problem: &Problem<'_>, factor: f64, options: &Options) -> Result<Solution, InputError> {
    let diagonal = problem.matrix.diagonal();
    iterate(problem, options, |b, _| {
        for (i, row) in problem.matrix.rows().enumerate() {
            b[i] += factor * (problem.right_hand_side[i] - dot(row, b)) / diagonal[i];
        }
    })
}

/// Progressive refinement (Cohen, Chen, Wallace and Greenberg, 1988): Southwell's relaxation, largest power first. The
/// residual is the unshot radiosity. An iteration is one shot per patch on average; then the residual is recomputed, so
/// that rounding errors do not accumulate.
pub(super) fn shoot(problem: &Problem<'_>, options: &Options) -> Result<Solution, InputError> {
    // A shot reads a column of the matrix.
    let (diagonal, columns) = (problem.matrix.diagonal(), problem.matrix.transposed());
    iterate(problem, options, |b, mut unshot| {
        for _ in 0..b.len() {
            let i = brightest(&unshot, problem.areas);
            let shot = unshot[i] / diagonal[i];
            b[i] += shot;
            for (left, m) in unshot.iter_mut().zip(columns.row(i)) {
                *left -= shot * m;
            }
            unshot[i] = 0.0;
        }
    })
}

/// The patch with the most unshot power; on ties, the first.
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

/// Solves by LU. This counts as one iteration; the tolerance only decides whether the solution counts as converged.
pub(super) fn direct(problem: &Problem<'_>, options: &Options) -> Result<Solution, InputError> {
    let radiosity =
        Lu::new(problem.matrix).map_err(|error| error.coded("radiosity::solve"))?.solve(problem.right_hand_side);
    let mut history = IterationHistory::new(problem, options);
    history.note(&residual(problem.matrix, problem.right_hand_side, &vec![0.0; problem.matrix.row_count()]))?;
    let left = residual(problem.matrix, problem.right_hand_side, &radiosity);
    history.note(&left)?;
    let converged = history.errors.last().is_some_and(|&error| error <= history.target);
    Ok(history.into_solution(radiosity, converged))
}
