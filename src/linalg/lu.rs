//! The direct solver: Gaussian elimination with partial pivoting, always in the same order.

use rayon::prelude::*;
use thiserror::Error;

use super::{Matrix, dot};

/// Steps on fewer elements than this stay on one thread.
const WORTH_THREADS: usize = 1 << 16;

/// A matrix as the product of a lower and an upper triangle, rows exchanged.
#[derive(Clone, Debug, PartialEq)]
pub struct Lu {
    /// Below the diagonal the lower triangle (its diagonal is 1), on and above it the upper one.
    both: Vec<f64>,
    /// Row i was row `from[i]` of the matrix.
    from: Vec<usize>,
}

/// The matrix has no inverse that f64 could tell from none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("expected an invertible matrix, found no pivot in column {column} (counted from 0)")]
pub struct Singular {
    /// The first column without a pivot.
    pub column: usize,
}

impl Lu {
    /// Factors a matrix.
    ///
    /// # Errors
    /// [`Singular`].
    pub fn new(matrix: &Matrix) -> Result<Self, Singular> {
        let n = matrix.size();
        let mut both: Vec<f64> = matrix.rows().flatten().copied().collect();
        let mut from: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let pivot = pivot_row(&both, n, k).ok_or(Singular { column: k })?;
            if pivot != k {
                let (above, below) = both.split_at_mut(pivot * n);
                above[k * n..(k + 1) * n].swap_with_slice(&mut below[..n]);
                from.swap(k, pivot);
            }
            eliminate(&mut both, n, k);
        }
        Ok(Self { both, from })
    }

    /// The x for which the matrix times x is `right`.
    ///
    /// # Panics
    /// If `right` is shorter than the matrix.
    #[must_use]
    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        let n = self.from.len();
        let mut x: Vec<f64> = Vec::with_capacity(n);
        for (i, &from) in self.from.iter().enumerate() {
            x.push(right[from] - dot(&self.both[i * n..i * n + i], &x));
        }
        for i in (0..n).rev() {
            let row = &self.both[i * n..(i + 1) * n];
            x[i] = (x[i] - dot(&row[i + 1..], &x[i + 1..])) / row[i];
        }
        x
    }
}

/// The row from k on with the largest element in column k, the first of equals; `None` if all are zero or one is no number.
fn pivot_row(both: &[f64], n: usize, k: usize) -> Option<usize> {
    let (mut best, mut at) = (0.0, None);
    for i in k..n {
        let size = both[i * n + k].abs();
        if !size.is_finite() {
            return None;
        }
        if size > best {
            (best, at) = (size, Some(i));
        }
    }
    at
}

/// Takes row k off all rows below, so that their column k vanishes. Every element has one operation: threads don't show.
fn eliminate(both: &mut [f64], n: usize, k: usize) {
    let (above, below) = both.split_at_mut((k + 1) * n);
    let pivot = &above[k * n..];
    let work = |row: &mut [f64]| {
        let factor = row[k] / pivot[k];
        row[k] = factor;
        for (value, p) in row[k + 1..].iter_mut().zip(&pivot[k + 1..]) {
            *value -= factor * p;
        }
    };
    if (n - k) * (n - k) < WORTH_THREADS {
        below.chunks_exact_mut(n).for_each(work);
    } else {
        below.par_chunks_exact_mut(n).for_each(work);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_exchanged_where_they_must_be() {
        let m = Matrix::new(3, vec![0.0, 2.0, 1.0, 4.0, 4.0, 0.0, 2.0, 0.0, 8.0]).expect("a matrix");
        let x = [1.0, -2.0, 3.0];
        assert_eq!(Lu::new(&m).expect("invertible").solve(&m.times(&x)), x);
    }

    #[test]
    fn a_matrix_without_inverse_is_refused() {
        let m = Matrix::new(2, vec![1.0, 2.0, 2.0, 4.0]).expect("a matrix");
        assert_eq!(Lu::new(&m), Err(Singular { column: 1 }));
        let nan = Matrix::new(1, vec![f64::NAN]).expect("a matrix");
        assert_eq!(Lu::new(&nan), Err(Singular { column: 0 }));
    }
}
