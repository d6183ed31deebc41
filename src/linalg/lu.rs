//! The direct solver: Gaussian elimination with partial pivoting.

use nalgebra::{DVector, Dyn};
use thiserror::Error;

use super::Matrix;

/// LU factorisation of a square matrix with row exchanges.
#[derive(Clone, Debug)]
pub struct Lu(nalgebra::LU<f64, Dyn, Dyn>);

/// Error: the matrix is singular to f64 precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("expected an invertible matrix, found no pivot in column {column} (counted from 0)")]
pub struct Singular {
    /// First column without a pivot.
    pub column: usize,
}

impl Lu {
    /// Factors a matrix.
    ///
    /// # Errors
    /// [`Singular`].
    ///
    /// # Panics
    /// If the matrix is not square.
    pub fn new(matrix: &Matrix) -> Result<Self, Singular> {
        assert!(matrix.is_square(), "a square matrix");
        let lu = matrix.to_nalgebra().lu();
        let pivots = lu.lu_internal().diagonal();
        match pivots.iter().position(|&pivot| pivot == 0.0 || !pivot.is_finite()) {
            Some(column) => Err(Singular { column }),
            None => Ok(Self(lu)),
        }
    }

    /// Solves for the x for which the matrix times x is `right`.
    ///
    /// # Panics
    /// If `right` does not have one element per row.
    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut x = DVector::from_column_slice(right);
        let solved = self.0.solve_mut(&mut x);
        assert!(solved, "no pivot is 0");
        x.as_slice().to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_exchanged_where_they_must_be() {
        let m = Matrix::new([3, 3], vec![0.0, 2.0, 1.0, 4.0, 4.0, 0.0, 2.0, 0.0, 8.0]).expect("a matrix");
        let x = [1.0, -2.0, 3.0];
        assert_eq!(Lu::new(&m).expect("invertible").solve(&m.times(&x)), x);
    }

    #[test]
    fn a_matrix_without_inverse_is_refused() {
        let m = Matrix::new([2, 2], vec![1.0, 2.0, 2.0, 4.0]).expect("a matrix");
        assert_eq!(Lu::new(&m).err(), Some(Singular { column: 1 }));
        let nan = Matrix::new([1, 1], vec![f64::NAN]).expect("a matrix");
        assert_eq!(Lu::new(&nan).err(), Some(Singular { column: 0 }));
    }
}
