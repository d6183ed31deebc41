//! Eigenvalues and eigenvectors; the arbitrary signs of the vectors follow a fixed rule.

use nalgebra::DMatrix;

use super::Matrix;
use crate::error::{InputError, input_error};

/// Maximum iterations per row or column before an eigenvalue or singular value counts as not converged.
const MAX_ITERATIONS: usize = 100;

pub(super) fn not_finite_error(found: usize) -> InputError {
    input_error!("expected finite elements, found {found} that are not finite")
}

pub(super) fn no_convergence_error(rows: usize, columns: usize) -> InputError {
    input_error!(
        "expected eigenvalues or singular values of {rows} x {columns} elements within \
         {MAX_ITERATIONS} iterations each"
    )
}

pub(super) fn residual_error(size: usize) -> InputError {
    input_error!("expected eigenvectors with A v = lambda v, found some of {size} x {size} elements that are not")
}

/// Eigenvalues and eigenvectors of a symmetric matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetricEigen {
    /// Eigenvalues, largest first.
    pub values: Vec<f64>,
    /// Row i is the unit eigenvector of eigenvalue i; its component of largest magnitude is positive.
    pub vectors: Matrix,
}

impl SymmetricEigen {
    /// Decomposes a symmetric matrix; only the lower triangle is read.
    pub fn new(matrix: &Matrix) -> Result<Self, InputError> {
        assert!(matrix.is_square(), "a square matrix");
        let (size, most) = (matrix.row_count(), iterations(matrix));
        let eigen = nalgebra::SymmetricEigen::try_new(finite(matrix)?, f64::EPSILON, most);
        let eigen = eigen.ok_or_else(|| no_convergence_error(size, size))?;
        let mut order: Vec<usize> = (0..size).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let vectors = DMatrix::from_fn(size, size, |row, column| {
            let vector = eigen.eigenvectors.column(order[row]);
            vector[column] * vector[vector.iamax()].signum()
        });
        let values = order.iter().map(|&i| eigen.eigenvalues[i]).collect();
        Ok(Self { values, vectors: Matrix::from_nalgebra(&vectors) })
    }
}

fn finite(matrix: &Matrix) -> Result<DMatrix<f64>, InputError> {
    match matrix.rows().flatten().filter(|value| !value.is_finite()).count() {
        0 => Ok(matrix.to_nalgebra()),
        found => Err(not_finite_error(found)),
    }
}

fn iterations(matrix: &Matrix) -> usize {
    MAX_ITERATIONS * matrix.row_count().max(matrix.column_count()).max(1)
}
