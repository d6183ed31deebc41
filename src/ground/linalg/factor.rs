//! Orthogonal factorisations, with a fixed choice of the arbitrary signs.

use nalgebra::{DMatrix, DVector, Dyn};

use super::Matrix;
use crate::error::{InputError, input_error};

/// Maximum iterations per row or column before an eigenvalue or singular value counts as not converged.
const MAX_ITERATIONS: usize = 100;

pub(super) fn not_finite_error(found: usize) -> InputError {
    input_error!("expected finite elements, found {found} that are not")
}

pub(super) fn no_convergence_error(rows: usize, columns: usize) -> InputError {
    input_error!(
        "expected eigenvalues or singular values of {rows} x {columns} elements within \
         {MAX_ITERATIONS} iterations each"
    )
}

fn rank_deficient_error(columns: usize, column: usize) -> InputError {
    input_error!(
        "expected {columns} independent columns, found column {column} (counted from 0) to depend on \
         those before it"
    )
}

pub(super) fn residual_error(size: usize) -> InputError {
    input_error!("expected eigenvectors with A v = lambda v, found some of {size} x {size} elements that are not")
}

/// Eigenvalues and eigenvectors of a symmetric matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetricEigen {
    /// Eigenvalues, the largest first.
    pub values: Vec<f64>,
    /// Row i is the unit eigenvector of eigenvalue i; its component of largest magnitude is positive.
    pub vectors: Matrix,
}

impl SymmetricEigen {
    /// Decomposes a symmetric matrix, of which only the lower triangle is read.
    ///
    /// # Errors
    /// [`InputError`] if an element is not finite, or the iteration does not converge.
    ///
    /// # Panics
    /// If the matrix is not square.
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

/// Thin singular value decomposition: `left` times the diagonal matrix of `values` times `right`.
#[derive(Clone, Debug, PartialEq)]
pub struct Svd {
    /// Orthonormal columns, as many as there are values.
    pub left: Matrix,
    /// Singular values, the largest first: as many as the matrix has rows or columns, whichever is fewer.
    pub values: Vec<f64>,
    /// Orthonormal rows; the component of largest magnitude of each is positive.
    pub right: Matrix,
}

impl Svd {
    /// Decomposes a matrix.
    ///
    /// # Errors
    /// [`InputError`] if an element is not finite, or the iteration does not converge.
    pub fn new(matrix: &Matrix) -> Result<Self, InputError> {
        let [rows, columns] = [matrix.row_count(), matrix.column_count()];
        let values = finite(matrix)?;
        if rows.min(columns) == 0 {
            let empty = |rows, columns| Matrix::from_nalgebra(&DMatrix::zeros(rows, columns));
            return Ok(Self { left: empty(rows, 0), values: Vec::new(), right: empty(0, columns) });
        }
        let svd = nalgebra::SVD::try_new(values, true, true, f64::EPSILON, iterations(matrix));
        let svd = svd.and_then(|svd| Some((svd.u?, svd.singular_values, svd.v_t?)));
        let (mut left, values, mut right) = svd.ok_or_else(|| no_convergence_error(rows, columns))?;
        for k in 0..values.len() {
            let sign = right[(k, right.row(k).iamax_full().1)].signum();
            left.column_mut(k).scale_mut(sign);
            right.row_mut(k).scale_mut(sign);
        }
        let values = values.as_slice().to_vec();
        Ok(Self { left: Matrix::from_nalgebra(&left), values, right: Matrix::from_nalgebra(&right) })
    }
}

/// QR factorisation of a matrix of independent columns, by Householder reflections.
#[derive(Clone, Debug)]
pub struct Qr(nalgebra::QR<f64, Dyn, Dyn>);

impl Qr {
    /// Factors a matrix with at least as many rows as columns.
    ///
    /// # Errors
    /// [`InputError`] if an element is not finite, or the columns are linearly dependent.
    pub fn new(matrix: &Matrix) -> Result<Self, InputError> {
        let [rows, columns] = [matrix.row_count(), matrix.column_count()];
        let values = finite(matrix)?;
        if rows < columns {
            return Err(rank_deficient_error(columns, rows));
        }
        let qr = values.qr();
        let diagonal = qr.r().diagonal().abs();
        let least = diagonal.max() * f64::EPSILON * rows as f64;
        match diagonal.iter().position(|&pivot| pivot <= least) {
            Some(column) => Err(rank_deficient_error(columns, column)),
            None => Ok(Self(qr)),
        }
    }

    /// Solves the least-squares problem: the x for which the matrix times x is nearest to `right`.
    ///
    /// # Panics
    /// If `right` does not have one element per row.
    pub fn least_squares(&self, right: &[f64]) -> Vec<f64> {
        let mut projected = DVector::from_column_slice(right);
        self.0.q_tr_mul(&mut projected);
        let r = self.0.r();
        let x = r.solve_upper_triangular(&projected.rows(0, r.ncols()));
        x.map_or_else(Vec::new, |x| x.as_slice().to_vec())
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
