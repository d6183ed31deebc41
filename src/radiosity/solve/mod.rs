//! Solvers of equation 2 on the host, in f64, with the convergence history that Figure 3 plots.

mod direct;
mod relax;
mod shoot;

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use crate::linalg::{Matrix, Singular};

/// How a system is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// Jacobi (equations 3 and 4): every element from those of the last iteration.
    Jacobi,
    /// Gauss-Seidel: every element from the newest values of the others.
    GaussSeidel,
    /// SOR with this relaxation factor, in (0, 2).
    OverRelaxation(f64),
    /// Progressive refinement (Cohen and others, 1988): shoots from the patch with the most unshot power. An
    /// iteration is as many shots as there are patches.
    Shooting,
    /// LU factorisation: no iterations.
    Direct,
}

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The norm of the residual, relative to that of the right-hand side, at which an iteration stops.
    pub tolerance: f64,
    /// The most iterations.
    pub most_iterations: u32,
}

impl Default for Options {
    fn default() -> Self {
        Self { tolerance: 1e-6, most_iterations: 1000 }
    }
}

/// A linear system with what solvers need beside it.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// M of equation 2. Its diagonal has no zero.
    pub matrix: &'a Matrix,
    /// The right-hand side, E.
    pub right_hand_side: &'a [f64],
    /// The areas of the patches: shooting goes by power.
    pub areas: &'a [f64],
    /// The initial guess; `None` means 0.
    pub start: Option<&'a [f64]>,
}

/// A solution with its convergence history.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// B.
    pub radiosity: Vec<f64>,
    /// The mean square of the residual E - M B, initially and after each iteration: Figure 3's error.
    pub history: Vec<f64>,
    /// Whether the tolerance was reached.
    pub converged: bool,
}

impl Solution {
    /// How many iterations it took.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.history.len() - 1
    }
}

/// Why there is no solution.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SolveError {
    /// Not one element per row.
    #[error("expected {rows} {what}, one per row of the matrix, found {found}")]
    Count {
        /// What there is too much or too little of.
        what: &'static str,
        /// Rows of the matrix.
        rows: usize,
        /// Elements found.
        found: usize,
    },
    /// A relaxation factor for which SOR cannot converge.
    #[error("expected a relaxation factor above 0 and below 2, found {0}")]
    Relaxation(f64),
    /// A zero on the diagonal.
    #[error("expected a diagonal without zeros, found one in row {row} (counted from 0)")]
    Diagonal {
        /// The row.
        row: usize,
    },
    /// The iteration diverges, or the input holds NaN or infinity.
    #[error("expected an iteration that converges, found no finite residual after {iterations} iterations")]
    Diverged {
        /// Iterations done.
        iterations: usize,
    },
    /// No inverse.
    #[error(transparent)]
    Singular(#[from] Singular),
}

/// Solves.
///
/// # Errors
/// [`SolveError`]. Reaching the most iterations is none: [`Solution::converged`] tells.
pub fn solve(solver: Solver, problem: &Problem<'_>, options: &Options) -> Result<Solution, SolveError> {
    check(problem)?;
    match solver {
        Solver::Direct => direct::solve(problem, options),
        Solver::Jacobi => relax::jacobi(problem, options),
        Solver::GaussSeidel => relax::gauss_seidel(problem, 1.0, options),
        Solver::OverRelaxation(factor) if factor > 0.0 && factor < 2.0 => relax::gauss_seidel(problem, factor, options),
        Solver::OverRelaxation(factor) => Err(SolveError::Relaxation(factor)),
        Solver::Shooting => shoot::shoot(problem, options),
    }
}

fn check(problem: &Problem<'_>) -> Result<(), SolveError> {
    let rows = problem.matrix.row_count();
    let counts = [
        ("columns", Some(problem.matrix.column_count())),
        ("emittances", Some(problem.right_hand_side.len())),
        ("areas", Some(problem.areas.len())),
        ("radiosities", problem.start.map(<[f64]>::len)),
    ];
    for (what, count) in counts {
        if let Some(found) = count.filter(|&found| found != rows) {
            return Err(SolveError::Count { what, rows, found });
        }
    }
    match problem.matrix.diagonal().iter().position(|&d| d == 0.0) {
        Some(row) => Err(SolveError::Diagonal { row }),
        None => Ok(()),
    }
}

/// The mean squares of the residuals so far, and the stopping criterion.
struct IterationHistory {
    errors: Vec<f64>,
    target: f64,
    max_iterations: u32,
}

impl IterationHistory {
    fn new(problem: &Problem<'_>, options: &Options) -> Self {
        let target = options.tolerance * options.tolerance * mean_square(problem.right_hand_side);
        Self { errors: Vec::new(), target, max_iterations: options.most_iterations }
    }

    /// Records a residual. `Some` if the iteration ends here: whether the tolerance is reached.
    fn note(&mut self, residual: &[f64]) -> Result<Option<bool>, SolveError> {
        let error = mean_square(residual);
        if !error.is_finite() {
            return Err(SolveError::Diverged { iterations: self.errors.len() });
        }
        self.errors.push(error);
        let converged = error <= self.target;
        Ok((converged || self.errors.len() > self.max_iterations as usize).then_some(converged))
    }

    fn into_solution(self, radiosity: Vec<f64>, converged: bool) -> Solution {
        Solution { radiosity, history: self.errors, converged }
    }
}

/// The mean square; 0 for no values.
#[must_use]
pub fn mean_square(values: &[f64]) -> f64 {
    crate::linalg::dot(values, values) / values.len().max(1) as f64
}

/// The residual, E - M B.
#[must_use]
pub fn residual(matrix: &Matrix, right_hand_side: &[f64], radiosity: &[f64]) -> Vec<f64> {
    matrix.times(radiosity).iter().zip(right_hand_side).map(|(mb, e)| e - mb).collect()
}

fn start(problem: &Problem<'_>) -> Vec<f64> {
    problem.start.map_or_else(|| vec![0.0; problem.matrix.row_count()], <[f64]>::to_vec)
}

impl fmt::Display for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Jacobi => f.write_str("jacobi"),
            Self::GaussSeidel => f.write_str("gauss-seidel"),
            Self::OverRelaxation(factor) => write!(f, "sor:{factor}"),
            Self::Shooting => f.write_str("shooting"),
            Self::Direct => f.write_str("direct"),
        }
    }
}

/// No solver has this name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("expected `jacobi`, `gauss-seidel`, `sor:FACTOR` (0 < FACTOR < 2), `shooting` or `direct`, found `{0}`")]
pub struct UnknownSolver(pub String);

impl FromStr for Solver {
    type Err = UnknownSolver;

    fn from_str(name: &str) -> Result<Self, UnknownSolver> {
        let unknown = || UnknownSolver(name.to_owned());
        match name {
            "jacobi" => Ok(Self::Jacobi),
            "gauss-seidel" => Ok(Self::GaussSeidel),
            "shooting" => Ok(Self::Shooting),
            "direct" => Ok(Self::Direct),
            _ => {
                let factor = name.strip_prefix("sor:").and_then(|factor| factor.parse().ok());
                factor
                    .filter(|&factor: &f64| factor > 0.0 && factor < 2.0)
                    .map(Self::OverRelaxation)
                    .ok_or_else(unknown)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        for solver in
            [Solver::Jacobi, Solver::GaussSeidel, Solver::OverRelaxation(1.25), Solver::Shooting, Solver::Direct]
        {
            assert_eq!(solver.to_string().parse(), Ok(solver));
        }
        for name in ["", "sor", "sor:2", "sor:nan", "Jacobi"] {
            assert_eq!(name.parse::<Solver>(), Err(UnknownSolver(name.to_owned())));
        }
    }
}
