//! Bidiagonalisation of a matrix by reflections: the first half of a singular value decomposition.

use rayon::prelude::*;

use super::reflection::Reflection;
use super::{Matrix, dot};

/// Rows per partial sum of a product with columns. Affects the bits of the result.
const BLOCK: usize = 32;

/// Number of elements below which one thread does the work.
const MIN_PARALLEL_ELEMENTS: usize = 1 << 15;

/// Bidiagonal form of a matrix with at least as many rows as columns, with the reflections of its rows and of its
/// columns.
pub(super) struct Bidiagonal {
    /// Diagonal elements.
    pub(super) diagonal: Vec<f64>,
    /// Superdiagonal elements: element i is to the right of diagonal element i.
    pub(super) above: Vec<f64>,
    /// Reflection k acts on rows k and up.
    left: Vec<Option<Reflection>>,
    /// Reflection k acts on columns k + 1 and up.
    right: Vec<Option<Reflection>>,
}

impl Bidiagonal {
    /// Bidiagonalises a matrix (Golub and Kahan 1965), with the two rank-one updates of a step fused, so that a step
    /// reads the matrix twice and writes it once.
    pub(super) fn new(matrix: Matrix) -> Self {
        let mut rest = Trailing::new(matrix);
        let columns = rest.columns;
        let mut found = Self { diagonal: Vec::new(), above: Vec::new(), left: Vec::new(), right: Vec::new() };
        let (mut update, mut column) = (None, rest.column(0));
        for k in 0..columns {
            let (left, diagonal) = Reflection::onto(column, 0);
            found.diagonal.push(diagonal);
            // Applies the previous step's update, fused with the product of this step's reflection.
            let product = rest.updated_product(k, update.take(), left.as_ref());
            if k + 1 == columns {
                found.left.push(left);
                break;
            }
            let beside = product.iter().skip(1).copied().collect::<Vec<f64>>();
            let first = left.as_ref().map_or(0.0, |left| left.axis[0]);
            let row = rest.row(k)[k + 1..].iter().zip(&beside).map(|(value, w)| value - first * w).collect();
            let (right, above) = Reflection::onto(row, 0);
            found.above.push(above);
            let step = rest.update(k, left.as_ref(), beside, right.as_ref());
            column = rest.next_column(k, &step);
            update = Some(step);
            found.left.push(left);
            found.right.push(right);
        }
        found
    }

    /// Transforms a left singular vector of the bidiagonal form to one of the matrix.
    pub(super) fn to_left(&self, vector: &mut [f64]) {
        for (k, reflection) in self.left.iter().enumerate().rev() {
            reflection.iter().for_each(|reflection| reflection.apply(&mut vector[k..]));
        }
    }

    /// Transforms a right singular vector of the bidiagonal form to one of the matrix.
    pub(super) fn to_right(&self, vector: &mut [f64]) {
        for (k, reflection) in self.right.iter().enumerate().rev() {
            reflection.iter().for_each(|reflection| reflection.apply(&mut vector[k + 1..]));
        }
    }
}

/// Rank-two update of a step: `left[i] beside[j] + product[i] right[j]` is subtracted from trailing element (i, j).
/// Vectors start at the first row and column after the step.
struct RankTwoUpdate {
    left: Vec<f64>,
    beside: Vec<f64>,
    product: Vec<f64>,
    right: Vec<f64>,
}

/// Matrix during the reduction; rows and columns from the current step on are not reduced yet.
struct Trailing {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
}

impl Trailing {
    fn new(matrix: Matrix) -> Self {
        let [rows, columns] = [matrix.row_count(), matrix.column_count()];
        Self { rows, columns, values: matrix.into_values() }
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.columns..(row + 1) * self.columns]
    }

    fn column(&self, column: usize) -> Vec<f64> {
        (column..self.rows).map(|row| self.row(row)[column]).collect()
    }

    fn is_small(&self, step: usize) -> bool {
        (self.rows - step) * (self.columns - step) < MIN_PARALLEL_ELEMENTS
    }

    /// Applies the previous step's update, and returns the product of the reflection's axis with the columns from
    /// `step` on, divided by the reflection's `half`. Partial sums of blocks of rows are added in order.
    fn updated_product(&mut self, step: usize, update: Option<RankTwoUpdate>, left: Option<&Reflection>) -> Vec<f64> {
        let (columns, small, width) = (self.columns, self.is_small(step), self.columns - step);
        let first_block = step / BLOCK;
        let block_of = |(block, values): (usize, &mut [f64])| {
            let first_row = (first_block + block) * BLOCK;
            let mut sum = vec![0.0; width];
            for (row, values) in (first_row..).zip(values.chunks_exact_mut(columns)).skip_while(|(row, _)| *row < step)
            {
                let values = &mut values[step..];
                let at = row - step;
                if let Some(RankTwoUpdate { left, beside, product, right }) = &update {
                    let (a, b) = (left[at], product[at]);
                    for ((value, beside), right) in values.iter_mut().zip(beside).zip(right) {
                        *value -= a * beside + b * right;
                    }
                }
                if let Some(left) = left {
                    let axis = left.axis[at];
                    sum.iter_mut().zip(&*values).for_each(|(sum, value)| *sum += axis * value);
                }
            }
            sum
        };
        let values = &mut self.values[first_block * BLOCK * columns..];
        // One thread uses the same blocks as several, so that the sums have the same bits.
        let sums: Vec<Vec<f64>> = if small {
            values.chunks_mut(BLOCK * columns).enumerate().map(block_of).collect()
        } else {
            values.par_chunks_mut(BLOCK * columns).enumerate().map(block_of).collect()
        };
        let mut product = vec![0.0; width];
        for sum in sums {
            product.iter_mut().zip(sum).for_each(|(product, sum)| *product += sum);
        }
        if let Some(left) = left {
            product.iter_mut().for_each(|value| *value /= left.half);
        }
        product
    }

    /// Computes the update of a step from its reflections and the left reflection's product with the trailing columns.
    fn update(
        &self,
        step: usize,
        left: Option<&Reflection>,
        beside: Vec<f64>,
        right: Option<&Reflection>,
    ) -> RankTwoUpdate {
        let behind = self.rows - step - 1;
        let left = left.map_or_else(|| vec![0.0; behind], |left| left.axis[1..].to_vec());
        let Some(right) = right else {
            let (product, zeros) = (vec![0.0; behind], vec![0.0; beside.len()]);
            return RankTwoUpdate { left, beside, product, right: zeros };
        };
        let along = dot(&beside, &right.axis);
        let product_of =
            |(row, left): (usize, &f64)| (dot(&self.row(row)[step + 1..], &right.axis) - left * along) / right.half;
        let product = if self.is_small(step) {
            (step + 1..self.rows).zip(&left).map(product_of).collect()
        } else {
            let rows = (step + 1..self.rows).into_par_iter().with_min_len(BLOCK);
            rows.zip(&left).map(product_of).collect()
        };
        RankTwoUpdate { left, beside, product, right: right.axis.clone() }
    }

    /// Column after a step, from its diagonal element down, with the step's update applied.
    fn next_column(&self, step: usize, update: &RankTwoUpdate) -> Vec<f64> {
        let [beside, right] = [&update.beside, &update.right].map(|of| of.first().copied().unwrap_or(0.0));
        let value = |row: usize| {
            let at = row - step - 1;
            self.row(row)[step + 1] - (update.left[at] * beside + update.product[at] * right)
        };
        (step + 1..self.rows).map(value).collect()
    }
}
