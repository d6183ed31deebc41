//! The largest eigenvalues of a symmetric matrix with their eigenvectors.
//!
//! The matrix is reduced to tridiagonal form by Householder reflections, and diagonalised by implicit QL rotations. The
//! rotations are recorded and applied only to the requested columns, so `count` of the n vectors cost O(n^2 count)
//! operations in addition to 4/3 n^3 for the reduction. [`SymmetricEigen`](super::SymmetricEigen), which computes all n
//! vectors, costs several times more.

use super::reflection::{Reflection, inverse_power_of_two, largest};
use super::tridiagonal::{diagonalise, rotated};
use super::{Matrix, dot};
use crate::error::InputError;
use crate::linalg::factor::{not_finite_error, residual_error};

/// Maximum accepted residual |A v - lambda v| of an eigenpair, relative to the infinity norm of A.
pub(super) const MAX_RESIDUAL: f64 = 1e-10;

/// All eigenvalues of a symmetric matrix, and the eigenvectors of the largest.
#[derive(Clone, Debug, PartialEq)]
pub struct LeadingEigen {
    /// All eigenvalues, largest first.
    pub values: Vec<f64>,
    /// Row i is the unit eigenvector of eigenvalue i; its component of largest magnitude is positive.
    pub vectors: Matrix,
}

impl LeadingEigen {
    /// Decomposes a symmetric matrix (only the lower triangle is read): computes the eigenvectors of its `count`
    /// largest eigenvalues, or of all if it has fewer. The function is inlined, so that the caller can compile it for
    /// wider vector instructions, which change no bit.
    #[inline(always)]
    pub fn new(matrix: &Matrix, count: usize) -> Result<Self, InputError> {
        assert!(matrix.is_square(), "a square matrix");
        let size = matrix.row_count();
        let lower = Lower::new(matrix)?;
        let norm = lower.infinity_norm();
        if norm == 0.0 {
            return Ok(Self::of_zeros(size, count));
        }
        let original = lower.clone();
        let Tridiagonal { mut diagonal, mut beside, reflections } = lower.into_tridiagonal();
        let rotations = diagonalise(&mut diagonal, &mut beside)?;
        let mut order: Vec<usize> = (0..size).collect();
        order.sort_by(|&a, &b| diagonal[b].total_cmp(&diagonal[a]));
        let values: Vec<f64> = order.iter().map(|&i| diagonal[i]).collect();
        order.truncate(count);
        let mut vectors = rotated(size, &order, &rotations);
        for (vector, &value) in vectors.chunks_exact_mut(size).zip(&values) {
            reflections.iter().for_each(|reflection| reflection.apply(vector));
            make_largest_positive(vector);
            let residual = original.residual(vector, value) / norm;
            if residual.is_nan() || residual > MAX_RESIDUAL {
                return Err(residual_error(size));
            }
        }
        let scale = original.scale;
        let vectors = Matrix::new([order.len(), size], vectors).expect("no larger than the matrix");
        Ok(Self { values: values.into_iter().map(|value| value / scale).collect(), vectors })
    }

    fn of_zeros(size: usize, count: usize) -> Self {
        let mut vectors = Matrix::zeros([count.min(size), size]).expect("no larger than the matrix");
        (0..vectors.row_count()).for_each(|i| vectors.row_mut(i)[i] = 1.0);
        Self { values: vec![0.0; size], vectors }
    }
}

/// Negates a vector if its component of largest magnitude (on ties, the first) is negative.
pub fn make_largest_positive(vector: &mut [f64]) {
    let mut largest = 0.0_f64;
    vector.iter().for_each(|&value| largest = if value.abs() > largest.abs() { value } else { largest });
    if largest < 0.0 {
        vector.iter_mut().for_each(|value| *value = -*value);
    }
}

/// Lower triangle of a symmetric matrix, scaled by a power of two that brings its largest magnitude near 1.
#[derive(Clone)]
struct Lower {
    /// Row i has i + 1 elements.
    rows: Vec<Vec<f64>>,
    scale: f64,
}

/// Tridiagonal form with its reflections: the diagonal, and the off-diagonal elements (element i is between i and i +
/// 1).
struct Tridiagonal {
    diagonal: Vec<f64>,
    beside: Vec<f64>,
    /// Reflections in the order that transforms a vector of the tridiagonal matrix to a vector of the original matrix.
    reflections: Vec<Reflection>,
}

impl Lower {
    fn new(matrix: &Matrix) -> Result<Self, InputError> {
        let lower = || matrix.rows().enumerate().map(|(i, row)| &row[..=i]);
        let found = lower().flatten().filter(|value| !value.is_finite()).count();
        if found > 0 {
            return Err(not_finite_error(found));
        }
        let most = lower().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
        let scale = inverse_power_of_two(most);
        Ok(Self { rows: lower().map(|row| row.iter().map(|value| value * scale).collect()).collect(), scale })
    }

    fn infinity_norm(&self) -> f64 {
        let mut sums = vec![0.0; self.rows.len()];
        for (i, row) in self.rows.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                sums[i] += value.abs();
                sums[j] += if i == j { 0.0 } else { value.abs() };
            }
        }
        sums.into_iter().fold(0.0, f64::max)
    }

    /// Product of the leading n rows and columns with `vector`, which has n elements.
    #[inline(always)]
    fn times(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; vector.len()];
        for (i, (&at, row)) in vector.iter().zip(&self.rows).enumerate() {
            let (left, right) = product.split_at_mut(i);
            right[0] = dot(&row[..i], &vector[..i]) + row[i] * at;
            left.iter_mut().zip(row).for_each(|(sum, value)| *sum += value * at);
        }
        product
    }

    fn residual(&self, vector: &[f64], value: f64) -> f64 {
        let product = self.times(vector);
        largest(product.iter().zip(vector).map(|(product, v)| (product - value * v).abs()))
    }

    #[inline(always)]
    fn into_tridiagonal(mut self) -> Tridiagonal {
        let size = self.rows.len();
        let (mut beside, mut reflections) = (vec![0.0; size.saturating_sub(1)], Vec::new());
        for i in (1..size).rev() {
            let (reflection, value) = Reflection::onto(self.rows[i][..i].to_vec(), i - 1);
            beside[i - 1] = value;
            let Some(Reflection { axis, half }) = reflection else { continue };
            let mut into = self.times(&axis);
            let along = dot(&axis, &into) / (2.0 * half * half);
            into.iter_mut().zip(&axis).for_each(|(value, axis)| *value = *value / half - along * axis);
            for (j, row) in self.rows[..i].iter_mut().enumerate() {
                let (a, b) = (axis[j], into[j]);
                let beside_it = into.iter().zip(&axis);
                row.iter_mut().zip(beside_it).for_each(|(value, (into, axis))| *value -= a * into + b * axis);
            }
            reflections.push(Reflection { axis, half });
        }
        reflections.reverse();
        let diagonal = self.rows.iter().enumerate().map(|(i, row)| row[i]).collect();
        Tridiagonal { diagonal, beside, reflections }
    }
}
