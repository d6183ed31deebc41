//! Dense matrices, stored by rows.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::dot;
use crate::error::{InputError, ensure, input_error};

/// Maximum number of rows of a square matrix.
pub const MAX_SQUARE: usize = 16_384;
/// Maximum number of elements of a matrix: 2 GiB of f64.
pub const MAX_ELEMENTS: usize = MAX_SQUARE * MAX_SQUARE;

/// Number of elements below which one thread computes products.
const MIN_PARALLEL_ELEMENTS: usize = 1 << 16;

/// Matrix of f64, stored by rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
}

impl Matrix {
    /// Creates a matrix from rows, columns and values.
    pub fn new([rows, columns]: [usize; 2], values: Vec<f64>) -> Result<Self, InputError> {
        let found = values.len();
        ensure!(elements([rows, columns])? == found, "expected {rows} x {columns} values, found {found}");
        Ok(Self { rows, columns, values })
    }

    /// Creates a matrix of zeros.
    pub fn zeros([rows, columns]: [usize; 2]) -> Result<Self, InputError> {
        Ok(Self { rows, columns, values: vec![0.0; elements([rows, columns])?] })
    }

    /// Number of rows.
    pub fn row_count(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn column_count(&self) -> usize {
        self.columns
    }

    /// Returns `true` if the numbers of rows and columns are equal.
    pub fn is_square(&self) -> bool {
        self.rows == self.columns
    }

    /// Returns a row. Panics if there is no such row.
    pub fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.columns..(row + 1) * self.columns]
    }

    /// Returns a mutable row. Panics if there is no such row.
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        &mut self.values[row * self.columns..(row + 1) * self.columns]
    }

    /// Iterates over all rows; empty if they have no columns.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values.chunks_exact(self.columns.max(1))
    }

    /// Iterates over all mutable rows in parallel.
    pub fn par_rows_mut(&mut self) -> impl IndexedParallelIterator<Item = &mut [f64]> {
        self.values.par_chunks_exact_mut(self.columns.max(1))
    }

    /// Iterates over mutable blocks of `count` rows; the last block may have fewer. Panics if `count` is 0.
    pub fn row_blocks_mut(&mut self, count: usize) -> impl ExactSizeIterator<Item = &mut [f64]> {
        assert!(count > 0, "at least one row");
        self.values.chunks_mut(count * self.columns.max(1))
    }

    /// Elements of the diagonal.
    pub fn diagonal(&self) -> Vec<f64> {
        self.rows().take(self.columns).enumerate().map(|(i, row)| row[i]).collect()
    }

    /// Product with a vector, one [`dot`] per row.
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        if self.values.len() < MIN_PARALLEL_ELEMENTS {
            return self.rows().map(|row| dot(row, vector)).collect();
        }
        self.values.par_chunks_exact(self.columns.max(1)).map(|row| dot(row, vector)).collect()
    }

    /// Product with a matrix, one [`dot`] per element.
    pub fn product(&self, other: &Self) -> Result<Self, InputError> {
        assert_eq!(self.columns, other.rows, "as many rows as columns");
        let (mut product, columns) = (Self::zeros([self.rows, other.columns])?, other.transposed());
        product.par_rows_mut().zip(0..self.rows).for_each(|(into, i)| {
            into.iter_mut().zip(columns.rows()).for_each(|(value, column)| *value = dot(self.row(i), column));
        });
        Ok(product)
    }

    /// Transposed matrix.
    pub fn transposed(&self) -> Self {
        let mut values = vec![0.0; self.values.len()];
        values.par_chunks_exact_mut(self.rows.max(1)).enumerate().for_each(|(column, into)| {
            into.iter_mut().zip(self.rows()).for_each(|(value, row)| *value = row[column]);
        });
        Self { rows: self.columns, columns: self.rows, values }
    }

    /// All elements, row by row.
    pub(super) fn into_values(self) -> Vec<f64> {
        self.values
    }

    pub(super) fn to_nalgebra(&self) -> DMatrix<f64> {
        DMatrix::from_row_slice(self.rows, self.columns, &self.values)
    }

    pub(super) fn from_nalgebra(matrix: &DMatrix<f64>) -> Self {
        let [rows, columns] = [matrix.nrows(), matrix.ncols()];
        // nalgebra stores columns.
        Self { rows: columns, columns: rows, values: matrix.as_slice().to_vec() }.transposed()
    }
}

fn elements([rows, columns]: [usize; 2]) -> Result<usize, InputError> {
    let elements = rows.checked_mul(columns).filter(|&elements| elements <= MAX_ELEMENTS);
    elements.ok_or_else(|| {
        input_error!(
            "expected a matrix of at most {MAX_ELEMENTS} elements ({MAX_SQUARE} x {MAX_SQUARE}), found \
         {rows} x {columns}"
        )
    })
}
