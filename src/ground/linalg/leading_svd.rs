//! All singular values of a matrix, with the vectors of the largest.
//!
//! Reflections of rows and columns reduce the matrix to bidiagonal form. Its singular values are the eigenvalues, each
//! with both signs, of the symmetric tridiagonal matrix with zeros in the diagonal and the elements of the two
//! diagonals beside it in turn (Golub and Kahan 1965), whose eigenvectors are right and left vector in turn. Since
//! nothing is squared, values are accurate to a few roundings of the largest, where those of Q^T Q would lose half of
//! the digits.

use rayon::prelude::*;

use super::bidiagonal::Bidiagonal;
use super::leading::{MAX_RESIDUAL, make_largest_positive};
use super::reflection::inverse_power_of_two;
use super::tridiagonal::{diagonalise, rotated};
use super::{Matrix, dot};
use crate::error::InputError;
use crate::linalg::factor::{not_finite_error, residual_error};

/// All singular values of a matrix, and the vectors of the largest.
#[derive(Clone, Debug, PartialEq)]
pub struct LeadingSvd {
    /// All singular values, the largest first: as many as the matrix has rows or columns, whichever is fewer.
    pub values: Vec<f64>,
    /// Numerical rank: the number of values above the largest times 2^-52 times the number of rows or columns,
    /// whichever is larger.
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
    ///
    /// # Errors
    /// [`InputError`] if an element is not finite, the iteration does not converge, or a pair of vectors does not
    /// satisfy A v = sigma u.
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
        let largest = matrix.rows().flatten().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        if largest == 0.0 {
            return Ok(Self { values: vec![0.0; columns], rank: 0, left: none(rows), right: none(columns) });
        }
        let scale = inverse_power_of_two(largest);
        let mut scaled = matrix.clone();
        scaled.par_rows_mut().for_each(|row| row.iter_mut().for_each(|value| *value *= scale));
        let bidiagonal = Bidiagonal::new(scaled);
        // Right and left in turn, from the right.
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

    /// Transforms the tridiagonal matrix's vectors to the matrix's, and checks them.
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
            // Beside a small value rounding mixes the vectors of it and of its negative.
            if dot(&product, &left) < 0.0 {
                left.iter_mut().for_each(|value| *value = -*value);
            }
            let differences = product.iter().zip(&left).map(|(product, left)| (product - value * left).abs());
            let residual =
                differences.fold(0.0, |most: f64, difference| if difference <= most { most } else { difference });
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

/// Empty matrix of vectors with this many elements.
fn none(elements: usize) -> Matrix {
    Matrix::zeros([0, elements]).expect("no elements")
}

fn normalise(vector: &mut [f64]) {
    let length = dot(vector, vector).sqrt();
    vector.iter_mut().for_each(|value| *value /= length);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Svd;
    use approx::assert_abs_diff_eq;

    fn matrix([rows, columns]: [usize; 2], rule: impl Fn(usize, usize) -> f64) -> Matrix {
        Matrix::new([rows, columns], (0..rows * columns).map(|at| rule(at / columns, at % columns)).collect())
            .expect("a small matrix")
    }

    /// Product of left vectors, values and right vectors.
    fn product(svd: &LeadingSvd) -> Matrix {
        let mut right = svd.right.clone();
        for (k, value) in svd.values.iter().enumerate().take(right.row_count()) {
            right.row_mut(k).iter_mut().for_each(|element| *element *= value);
        }
        svd.left.transposed().product(&right).expect("a small matrix")
    }

    fn largest_difference(a: &Matrix, b: &Matrix) -> f64 {
        a.rows().flatten().zip(b.rows().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    fn assert_orthonormal(rows: &Matrix, tolerance: f64) {
        for (i, a) in rows.rows().enumerate() {
            for (j, b) in rows.rows().enumerate() {
                assert_abs_diff_eq!(dot(a, b), f64::from(u8::from(i == j)), epsilon = tolerance);
            }
        }
    }

    #[test]
    fn values_and_vectors_are_those_of_the_full_factorisation() {
        for size in [[1, 1], [2, 2], [3, 7], [40, 40], [90, 33], [33, 90], [200, 190], [1, 5], [5, 1]] {
            let m = matrix(size, |i, j| ((i * 31 + j * 17 + i * j * j) % 23) as f64 - 11.0);
            let (all, leading) = (Svd::new(&m).expect("all"), LeadingSvd::new(&m, usize::MAX).expect("leading"));
            assert_eq!(all.values.len(), leading.values.len());
            for (a, b) in all.values.iter().zip(&leading.values) {
                assert_abs_diff_eq!(a, b, epsilon = 1e-13 * all.values[0]);
            }
            assert!(largest_difference(&product(&leading), &m) < 1e-12 * all.values[0], "{size:?}");
            assert_orthonormal(&leading.left, 1e-10);
            assert_orthonormal(&leading.right, 1e-10);
            let one = LeadingSvd::new(&m, 1).expect("one");
            let same = |a: &Matrix, b: &Matrix| a.row(0).iter().zip(b.row(0)).all(|(a, b)| a.to_bits() == b.to_bits());
            assert!(same(&one.right, &leading.right) && same(&one.left, &leading.left), "{size:?}");
        }
    }

    /// Squares of the small values would underflow relative to the square of the largest.
    #[test]
    fn small_values_keep_their_digits() {
        let m = matrix([20, 20], |i, j| if i == j { (0..i).fold(1.0, |value, _| value * 0.25) } else { 0.0 });
        let leading = LeadingSvd::new(&m, 20).expect("all");
        assert_eq!(leading.rank, 20);
        for (k, value) in leading.values.iter().enumerate() {
            assert_abs_diff_eq!(*value, m.row(k)[k], epsilon = 4.0 * f64::EPSILON * m.row(k)[k]);
        }
        // The same values behind rotations.
        let turned = matrix([20, 20], |i, j| {
            let h = |a: usize, b: usize| f64::from(u8::from(a == b)) - 2.0 * (a + 1) as f64 * (b + 1) as f64 / 2870.0;
            (0..20).map(|k| h(i, k) * m.row(k)[k] * h(k, j)).sum()
        });
        for (a, b) in LeadingSvd::new(&turned, 0).expect("values").values.iter().zip(&leading.values) {
            assert_abs_diff_eq!(a, b, epsilon = 1e-15);
        }
    }

    #[test]
    fn ranks_below_the_size_and_equal_values_are_found() {
        let ones = LeadingSvd::new(&matrix([30, 20], |_, _| 1.0), 9).expect("one");
        assert_eq!((ones.rank, ones.left.row_count(), ones.right.row_count()), (1, 1, 1));
        assert_abs_diff_eq!(ones.values[0], 600.0_f64.sqrt(), epsilon = 1e-12);
        let same = LeadingSvd::new(&matrix([9, 9], |i, j| if i == j { 3.0 } else { 0.0 }), 9).expect("all");
        assert_eq!(same.rank, 9);
        same.values.iter().for_each(|value| assert_abs_diff_eq!(*value, 3.0, epsilon = 1e-15));
        assert_orthonormal(&same.left, 1e-15);
        let ring = matrix([33, 33], |i, j| f64::from(u8::from((i + 1) % 33 == j || (j + 1) % 33 == i)));
        let pairs = LeadingSvd::new(&ring, 33).expect("all");
        assert!(largest_difference(&product(&pairs), &ring) < 1e-13);
        let zero = LeadingSvd::new(&matrix([4, 3], |_, _| 0.0), 2).expect("none");
        assert_eq!((zero.rank, zero.values, zero.right.row_count()), (0, vec![0.0; 3], 0));
        assert_eq!(LeadingSvd::new(&matrix([0, 0], |_, _| 0.0), 2).expect("none").values, [0.0; 0]);
    }

    /// Zero rows and columns between others, as maps have beyond their rim.
    #[test]
    fn zeros_in_between_change_nothing() {
        let inner = |i: usize, j: usize| 1.0 / (1.0 + i as f64 + 2.0 * j as f64);
        let whole = matrix([12, 12], inner);
        let at = |i: usize| (i % 3 != 1).then_some(i / 3 * 2 + i % 3 / 2);
        let holed = matrix([18, 18], |i, j| at(i).zip(at(j)).map_or(0.0, |(i, j)| inner(i, j)));
        let [whole, holed] = [whole, holed].map(|m| LeadingSvd::new(&m, 6).expect("values"));
        assert_eq!(whole.rank, holed.rank);
        for (a, b) in whole.values.iter().zip(&holed.values) {
            assert_abs_diff_eq!(a, b, epsilon = 18.0 * f64::EPSILON * whole.values[0]);
        }
    }

    #[test]
    fn any_magnitude_is_taken_and_no_number_refused() {
        for scale in [1e-290, 1.0, 1e290] {
            let m = matrix([9, 7], |i, j| scale * ((i * 5 + j * j) % 7) as f64);
            let (all, leading) = (Svd::new(&m).expect("all"), LeadingSvd::new(&m, 2).expect("two"));
            assert_abs_diff_eq!(all.values[0] / scale, leading.values[0] / scale, epsilon = 1e-12);
        }
        let nan = matrix([3, 3], |i, j| if i == 2 && j == 1 { f64::NAN } else { 1.0 });
        assert_eq!(LeadingSvd::new(&nan, 1).unwrap_err().to_string(), "expected finite elements, found 1 that are not");
    }
}
