//! All singular values of a matrix, with the vectors of the largest.
//!
//! Reflections of rows and columns reduce the matrix to bidiagonal form. Its singular values, with both signs, are the
//! eigenvalues of a symmetric tridiagonal matrix (Golub and Kahan 1965): the diagonal is zero, and the off-diagonal
//! elements alternate between the bidiagonal's two diagonals. The elements of an eigenvector are alternately elements
//! of the right and the left singular vector. Nothing is squared, so values are accurate to a few roundings of the
//! largest; eigenvalues of Q^T Q would lose half of the digits.

use rayon::prelude::*;

use super::bidiagonal::Bidiagonal;
use super::leading::{MAX_RESIDUAL, make_largest_positive};
use super::reflection::{inverse_power_of_two, largest};
use super::tridiagonal::{diagonalise, rotated};
use super::{Matrix, dot};
use crate::error::InputError;
use crate::linalg::factor::{not_finite_error, residual_error};

/// All singular values of a matrix, and the vectors of the largest.
#[derive(Clone, Debug, PartialEq)]
pub struct LeadingSvd {
    /// All singular values, largest first; as many as the matrix has rows or columns, whichever are fewer.
    pub values: Vec<f64>,
    /// Numerical rank: the number of values above 2^-52 m s, where m is the number of rows or of columns, whichever is
    /// larger, and s the largest value.
    pub rank: usize,
    /// Row k is the unit left singular vector of value k: an element per row of the matrix.
    pub left: Matrix,
    /// Row k is the unit right singular vector of value k: an element per column. Its component of largest magnitude is
    /// positive.
    pub right: Matrix,
}

impl LeadingSvd {
    /// Decomposes a matrix: computes the vectors of its `count` largest singular values, or of all within
    /// [`Self::rank`] if these are fewer. The bits do not depend on the number of threads.
    pub fn new(matrix: &Matrix, count: usize) -> Result<Self, InputError> {
        if matrix.row_count() < matrix.column_count() {
            let Self { values, rank, left, right } = Self::of_tall(&matrix.transposed(), count)?;
            return Ok(Self { values, rank, left: right, right: left }.with_signs());
        }
        Ok(Self::of_tall(matrix, count)?.with_signs())
    }

    /// Decomposes a matrix with at least as many rows as columns.
    fn of_tall(matrix: &Matrix, count: usize) -> Result<Self, InputError> {
        let found = matrix.rows().flatten().filter(|value| !value.is_finite()).count();
        if found > 0 {
            return Err(not_finite_error(found));
        }
        let [rows, columns] = [matrix.row_count(), matrix.column_count()];
        let most = matrix.rows().flatten().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        if most == 0.0 {
            return Ok(Self { values: vec![0.0; columns], rank: 0, left: none(rows), right: none(columns) });
        }
        let scale = inverse_power_of_two(most);
        let mut scaled = matrix.clone();
        scaled.par_rows_mut().for_each(|row| row.iter_mut().for_each(|value| *value *= scale));
        let bidiagonal = Bidiagonal::new(scaled);
        // Elements of right and left vectors alternate, beginning with the right one.
        let mut beside = vec![0.0; 2 * columns - 1];
        beside.iter_mut().step_by(2).zip(&bidiagonal.diagonal).for_each(|(to, &from)| *to = from);
        beside.iter_mut().skip(1).step_by(2).zip(&bidiagonal.above).for_each(|(to, &from)| *to = from);
        let mut diagonal = vec![0.0; 2 * columns];
        let rotations = diagonalise(&mut diagonal, &mut beside)?;
        let mut order: Vec<usize> = (0..2 * columns).collect();
        order.sort_by(|&a, &b| diagonal[b].total_cmp(&diagonal[a]));
        order.truncate(columns);
        let values: Vec<f64> = order.iter().map(|&i| diagonal[i].max(0.0)).collect();
        let least = values[0] * f64::EPSILON * rows as f64;
        let rank = values.iter().filter(|&&value| value > least).count();
        order.truncate(count.min(rank));
        let vectors = rotated(2 * columns, &order, &rotations);
        drop(rotations);
        let mut found = Self { values, rank, left: none(rows), right: none(columns) };
        found.fill(matrix, scale, &bidiagonal, &vectors)?;
        found.values.iter_mut().for_each(|value| *value /= scale);
        Ok(found)
    }

    /// Transforms the tridiagonal matrix's eigenvectors to singular vectors of the matrix, and checks them.
    fn fill(
        &mut self,
        matrix: &Matrix,
        scale: f64,
        bidiagonal: &Bidiagonal,
        vectors: &[f64],
    ) -> Result<(), InputError> {
        let [rows, columns] = [matrix.row_count(), matrix.column_count()];
        let (mut lefts, mut rights) = (Vec::new(), Vec::new());
        for (vector, &value) in vectors.chunks_exact(2 * columns).zip(&self.values) {
            let mut right: Vec<f64> = vector.iter().step_by(2).copied().collect();
            let mut left: Vec<f64> = vector.iter().skip(1).step_by(2).copied().collect();
            left.resize(rows, 0.0);
            bidiagonal.to_left(&mut left);
            bidiagonal.to_right(&mut right);
            normalise(&mut left);
            normalise(&mut right);
            let product: Vec<f64> = matrix.times(&right).into_iter().map(|value| value * scale).collect();
            // For a small value, rounding mixes the vectors of the value and of its negative.
            if dot(&product, &left) < 0.0 {
                left.iter_mut().for_each(|value| *value = -*value);
            }
            let residual = largest(product.iter().zip(&left).map(|(product, left)| (product - value * left).abs()));
            if residual.is_nan() || residual > MAX_RESIDUAL * self.values[0] {
                return Err(residual_error(rows.max(columns)));
            }
            lefts.extend(left);
            rights.extend(right);
        }
        let count = lefts.len() / rows;
        self.left = Matrix::new([count, rows], lefts)?;
        self.right = Matrix::new([count, columns], rights)?;
        Ok(())
    }

    fn with_signs(mut self) -> Self {
        for k in 0..self.right.row_count() {
            let before = self.right.row(k).to_vec();
            make_largest_positive(self.right.row_mut(k));
            if before != self.right.row(k) {
                self.left.row_mut(k).iter_mut().for_each(|value| *value = -*value);
            }
        }
        self
    }
}

fn none(elements: usize) -> Matrix {
    Matrix::zeros([0, elements]).expect("no elements")
}

fn normalise(vector: &mut [f64]) {
    let length = dot(vector, vector).sqrt();
    vector.iter_mut().for_each(|value| *value /= length);
}
