//! The direct solver: Gaussian elimination with partial pivoting.
//!
//! Panels of columns are eliminated from all rows below them at once, rows in parallel. Products are subtracted from
//! each element one by one in the order of the pivots, so panels, tiles and threads change no bit: the result equals
//! elimination column by column, as in nalgebra.

use rayon::prelude::*;

use super::Matrix;
use crate::error::{InputError, ensure};

const PANEL: usize = 64;
/// Number of columns that are updated at once, so that a panel's rows stay in a core's cache.
const TILE: usize = 256;
const ROWS: usize = 16;

/// LU factorisation of a square matrix with row exchanges.
#[derive(Clone, Debug)]
pub struct Lu {
    size: usize,
    /// Row by row: U on and above the diagonal, L below it, whose diagonal is 1.
    values: Vec<f64>,
    /// For each row, its row index in the matrix.
    order: Vec<usize>,
}

impl Lu {
    /// Factors a matrix. Panics if the matrix is not square.
    pub fn new(matrix: &Matrix) -> Result<Self, InputError> {
        assert!(matrix.is_square(), "a square matrix");
        let size = matrix.row_count();
        let values = matrix.rows().flatten().copied().collect();
        let mut lu = Self { size, values, order: (0..size).collect() };
        for first in (0..size).step_by(PANEL) {
            let end = size.min(first + PANEL);
            lu.factor_panel(first, end)?;
            lu.eliminate_panel(first, end);
        }
        Ok(lu)
    }

    /// Factors the columns from `first` to `end`, and exchanges whole rows.
    fn factor_panel(&mut self, first: usize, end: usize) -> Result<(), InputError> {
        let size = self.size;
        for column in first..end {
            let magnitude = |row: usize| self.values[row * size + column].abs();
            let largest = |best, row| if magnitude(row) > magnitude(best) { row } else { best };
            self.exchange_rows(column, (column + 1..size).fold(column, largest));
            let (above, below) = self.values.split_at_mut((column + 1) * size);
            let pivot_row = &above[column * size..];
            let pivot = pivot_row[column];
            ensure!(
                pivot != 0.0 && pivot.is_finite(),
                "expected an invertible matrix, found no pivot in column {column} (counted from 0)"
            );
            let inverse = 1.0 / pivot;
            for row in below.chunks_exact_mut(size) {
                row[column] *= inverse;
                let factor = row[column];
                subtract(&mut row[column + 1..end], factor, &pivot_row[column + 1..end]);
            }
        }
        Ok(())
    }

    /// Subtracts the multiples of a factored panel's rows from the columns to the right of the panel.
    fn eliminate_panel(&mut self, first: usize, end: usize) {
        let size = self.size;
        let (above, below) = self.values.split_at_mut(end * size);
        let panel = &mut above[first * size..];
        for place in 1..end - first {
            let (done, rest) = panel.split_at_mut(place * size);
            let (factors, right) = rest[..size].split_at_mut(end);
            for (factor, row) in factors[first..].iter().zip(done.chunks_exact(size)) {
                subtract(right, *factor, &row[end..]);
            }
        }
        let panel = &above[first * size..];
        below.par_chunks_mut(ROWS * size).for_each(|rows| {
            for from in (end..size).step_by(TILE) {
                let tile = from..size.min(from + TILE);
                for row in rows.chunks_exact_mut(size) {
                    let (factors, right) = row.split_at_mut(end);
                    let into = &mut right[tile.start - end..tile.end - end];
                    subtract_all(into, &factors[first..], |k| &panel[k * size..][tile.clone()]);
                }
            }
        });
    }

    fn exchange_rows(&mut self, one: usize, other: usize) {
        if one < other {
            let (before, from) = self.values.split_at_mut(other * self.size);
            before[one * self.size..][..self.size].swap_with_slice(&mut from[..self.size]);
            self.order.swap(one, other);
        }
    }

    /// Solves A x = `right`. Panics if `right` does not have one element per row.
    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        assert_eq!(right.len(), self.size, "one element per row");
        let mut x: Vec<f64> = self.order.iter().map(|&row| right[row]).collect();
        let row = |i: usize| &self.values[i * self.size..][..self.size];
        for i in 0..self.size {
            x[i] = (0..i).fold(x[i], |left, k| left - x[k] * row(i)[k]);
        }
        for i in (0..self.size).rev() {
            x[i] = (i + 1..self.size).rev().fold(x[i], |left, k| left - x[k] * row(i)[k]) / row(i)[i];
        }
        x
    }
}

fn subtract(into: &mut [f64], factor: f64, row: &[f64]) {
    into.iter_mut().zip(row).for_each(|(value, other)| *value -= factor * other);
}

/// Subtracts all factors times their rows from `into`, in order, four rows per pass over `into`.
fn subtract_all<'a>(into: &mut [f64], factors: &[f64], row: impl Fn(usize) -> &'a [f64]) {
    let (fours, rest) = factors.as_chunks::<4>();
    for (at, &[f, g, h, i]) in fours.iter().enumerate() {
        let [p, q, r, s] = [0, 1, 2, 3].map(|k| row(4 * at + k));
        let rows = p.iter().zip(q).zip(r).zip(s);
        for (value, (((p, q), r), s)) in into.iter_mut().zip(rows) {
            *value = (((*value - f * p) - g * q) - h * r) - i * s;
        }
    }
    for (at, &factor) in rest.iter().enumerate() {
        subtract(into, factor, row(4 * fours.len() + at));
    }
}
