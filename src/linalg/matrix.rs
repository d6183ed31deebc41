//! Square matrices by rows.

use rayon::prelude::*;
use thiserror::Error;

use super::dot;

/// The largest matrix that is made: 2 GiB of f64.
pub const MOST_ROWS: usize = 16_384;

/// Products of fewer elements than this stay on one thread.
const WORTH_THREADS: usize = 1 << 16;

/// A square matrix of f64, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    size: usize,
    values: Vec<f64>,
}

/// Why numbers make no matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum MatrixError {
    /// Too many rows.
    #[error("expected a matrix of at most {MOST_ROWS} rows, found {rows}")]
    TooLarge {
        /// The rows asked for.
        rows: usize,
    },
    /// The number of values is not the square of the number of rows.
    #[error("expected {rows} x {rows} values, found {values}")]
    Shape {
        /// The rows asked for.
        rows: usize,
        /// The values given.
        values: usize,
    },
}

impl Matrix {
    /// A matrix of `size` rows and columns.
    ///
    /// # Errors
    /// [`MatrixError`] if it is too large, or the values do not fill it.
    pub fn new(size: usize, values: Vec<f64>) -> Result<Self, MatrixError> {
        if size > MOST_ROWS {
            return Err(MatrixError::TooLarge { rows: size });
        }
        if values.len() != size * size {
            return Err(MatrixError::Shape { rows: size, values: values.len() });
        }
        Ok(Self { size, values })
    }

    /// A matrix of zeros.
    ///
    /// # Errors
    /// [`MatrixError::TooLarge`].
    pub fn zero(size: usize) -> Result<Self, MatrixError> {
        if size > MOST_ROWS {
            return Err(MatrixError::TooLarge { rows: size });
        }
        Ok(Self { size, values: vec![0.0; size * size] })
    }

    /// Rows, and columns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// A row.
    ///
    /// # Panics
    /// If there is no such row.
    #[must_use]
    pub fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.size..(row + 1) * self.size]
    }

    /// A row, to be written.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        &mut self.values[row * self.size..(row + 1) * self.size]
    }

    /// All rows, from the first.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        // A matrix without rows still needs a width that is not 0.
        self.values.chunks_exact(self.size.max(1))
    }

    /// All rows, to be written on all threads.
    pub fn par_rows_mut(&mut self) -> impl IndexedParallelIterator<Item = &mut [f64]> {
        self.values.par_chunks_exact_mut(self.size.max(1))
    }

    /// The elements of the diagonal.
    #[must_use]
    pub fn diagonal(&self) -> Vec<f64> {
        self.rows().enumerate().map(|(i, row)| row[i]).collect()
    }

    /// The product with a vector, a [`dot`] a row.
    #[must_use]
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        if self.values.len() < WORTH_THREADS {
            return self.rows().map(|row| dot(row, vector)).collect();
        }
        self.values.par_chunks_exact(self.size.max(1)).map(|row| dot(row, vector)).collect()
    }

    /// Rows as columns.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let mut values = vec![0.0; self.values.len()];
        values.par_chunks_exact_mut(self.size.max(1)).enumerate().for_each(|(column, into)| {
            for (value, row) in into.iter_mut().zip(self.rows()) {
                *value = row[column];
            }
        });
        Self { size: self.size, values }
    }

    /// The largest row sum of magnitudes: the norm that belongs to the largest element of a vector.
    #[must_use]
    pub fn norm(&self) -> f64 {
        self.rows().map(|row| row.iter().map(|x| x.abs()).sum()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_columns_and_products() {
        let m = Matrix::new(2, vec![1.0, 2.0, 3.0, 4.0]).expect("a matrix");
        assert_eq!(m.times(&[1.0, 10.0]), [21.0, 43.0]);
        assert_eq!(m.transposed().times(&[1.0, 10.0]), [31.0, 42.0]);
        assert_eq!((m.diagonal(), m.norm()), (vec![1.0, 4.0], 7.0));
        assert_eq!(Matrix::zero(0).expect("a matrix").times(&[]), Vec::<f64>::new());
    }

    #[test]
    fn what_makes_no_matrix_is_refused() {
        assert_eq!(Matrix::new(2, vec![0.0; 3]), Err(MatrixError::Shape { rows: 2, values: 3 }));
        assert_eq!(Matrix::zero(MOST_ROWS + 1), Err(MatrixError::TooLarge { rows: MOST_ROWS + 1 }));
    }
}
