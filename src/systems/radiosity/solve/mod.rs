//! Solvers of equation 2 on the host, in f64, with the convergence history that Figure 3 plots.

mod methods;
mod problem;

use std::fmt;
use std::str::FromStr;

pub use problem::{Options, Problem, Solution, mean_square, residual};

use crate::error::{InputError, input_error};

/// Method of solution.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// Jacobi (equations 3 and 4): every element is computed from the previous iteration's elements.
    Jacobi,
    /// Gauss-Seidel: every element is computed from the newest values of the others.
    GaussSeidel,
    /// SOR with this relaxation factor, in (0, 2).
    OverRelaxation(f64),
    /// Progressive refinement: shoots from the patch with the most unshot power, once per patch and iteration.
    Shooting,
    /// LU factorisation: no iterations.
    Direct,
}

/// Solves a system. Reaching the maximum number of iterations is not an error: see [`Solution::converged`].
pub fn solve(solver: Solver, problem: &Problem<'_>, options: &Options) -> Result<Solution, InputError> {
    check(problem)?;
    match solver {
        Solver::Direct => methods::direct(problem, options),
        Solver::Jacobi => methods::jacobi(problem, options),
        Solver::GaussSeidel => methods::gauss_seidel(problem, 1.0, options),
        Solver::OverRelaxation(factor) if factor > 0.0 && factor < 2.0 => {
            methods::gauss_seidel(problem, factor, options)
        }
        Solver::OverRelaxation(factor) => {
            Err(input_error!("radiosity::solve" => "expected a relaxation factor above 0 and below 2, found {factor}"))
        }
        Solver::Shooting => methods::shoot(problem, options),
    }
}

fn check(problem: &Problem<'_>) -> Result<(), InputError> {
    let rows = problem.matrix.row_count();
    let counts = [
        ("columns", problem.matrix.column_count()),
        ("emittances", problem.right_hand_side.len()),
        ("areas", problem.areas.len()),
    ];
    if let Some((what, found)) = counts.into_iter().find(|&(_, found)| found != rows) {
        return Err(input_error!("radiosity::solve" =>
            "expected {rows} {what}, one per row of the matrix, found {found}"));
    }
    match problem.matrix.diagonal().iter().position(|&d| d == 0.0) {
        Some(row) => Err(input_error!("radiosity::solve" =>
            "expected a diagonal without zeros, found one in row {row} (counted from 0)")),
        None => Ok(()),
    }
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

impl FromStr for Solver {
    type Err = InputError;

    fn from_str(name: &str) -> Result<Self, InputError> {
        let unknown = || {
            input_error!(
                "expected `jacobi`, `gauss-seidel`, `sor:FACTOR` (0 < FACTOR < 2), `shooting` or `direct`, \
         found `{name}`"
            )
        };
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
