//! Inner products of all pairs of a cluster's points.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::products::{Packed, ROWS, add_block};
use crate::error::InputError;
use crate::linalg::Matrix;

/// Columns of a block.
pub(super) const COLUMNS: usize = 8;
/// Products of fewer numbers than this are made by one thread.
const MIN_PARALLEL: usize = 1 << 22;
/// Points of a cluster whose products are kept, at most: 2 MiB.
const MOST_KEPT: usize = 512;

/// Inner products of a cluster's points, kept from one fit to the next, so that only those of new points are computed.
/// Each is the same sum whatever the other points are, so that reuse changes no bits.
#[derive(Clone, Debug, Default)]
pub(super) struct KeptProducts {
    points: Vec<u32>,
    /// The lower triangle.
    products: Option<Matrix>,
}

impl KeptProducts {
    /// The inner products of points, in increasing order: the lower triangle. `vector` writes the numbers of a point.
    pub(super) fn of(
        &self,
        points: &[u32],
        length: usize,
        level: SimdLevel,
        vector: impl Fn(u32, &mut [f64]) + Sync,
    ) -> Result<Matrix, InputError> {
        let size = points.len();
        let mut products = square(size)?;
        let before: Vec<Option<usize>> = points.iter().map(|point| self.points.binary_search(point).ok()).collect();
        let new: Vec<usize> = (0..size).filter(|&at| before[at].is_none()).collect();
        let Some(kept) = self.products.as_ref().filter(|_| 2 * new.len() < size) else {
            let vector = |at: usize, into: &mut [f64]| vector(points[at], into);
            let (rows, columns) = (Packed::new(size, length, vector), Packed::new(size, length, vector));
            add_products(&mut products, &rows, &columns, level);
            return Ok(products);
        };
        for (row, &from) in before.iter().enumerate() {
            let Some(from) = from else { continue };
            let (into, from) = (products.row_mut(row), kept.row(from));
            for (value, column) in into.iter_mut().zip(&before[..=row]) {
                column.iter().for_each(|&column| *value = from[column]);
            }
        }
        let rows = Packed::<ROWS>::new(new.len(), length, |at, into| vector(points[new[at]], into));
        let columns = Packed::<COLUMNS>::new(size, length, |at, into| vector(points[at], into));
        for (rows, new) in rows.groups().zip(new.chunks(ROWS)) {
            for (group, columns) in columns.groups().enumerate() {
                let mut sums = [[0.0; COLUMNS]; ROWS];
                level.run(
                    #[inline(always)]
                    || add_block(rows, columns, &mut sums),
                );
                for (&at, sums) in new.iter().zip(&sums) {
                    for (other, &sum) in (group * COLUMNS..size).zip(sums) {
                        products.row_mut(at.max(other))[at.min(other)] = sum;
                    }
                }
            }
        }
        Ok(products)
    }

    /// Keeps the products of these points, unless they are too many.
    pub(super) fn keep(&mut self, points: &[u32], products: Matrix) {
        *self = Self::default();
        if points.len() <= MOST_KEPT {
            (self.points, self.products) = (points.to_vec(), Some(products));
        }
    }
}

/// Adds the products of all pairs of vectors, which are both `rows` and `columns`, to the lower triangle; what stands
/// above it is not used.
pub(super) fn add_products(products: &mut Matrix, rows: &Packed<ROWS>, columns: &Packed<COLUMNS>, level: SimdLevel) {
    let size = products.row_count();
    let rows: Vec<_> = rows.groups().collect();
    let length = rows.first().map_or(0, |row| row.len());
    let add_rows = |tile: usize, into: &mut [f64]| {
        level.run(
            #[inline(always)]
            || {
                for (group, column) in columns.groups().enumerate().take(((tile + 1) * ROWS).div_ceil(COLUMNS)) {
                    let mut sums = [[0.0; COLUMNS]; ROWS];
                    add_block(rows[tile], column, &mut sums);
                    for (row, sums) in into.chunks_exact_mut(size).zip(&sums) {
                        for (into, sum) in row[group * COLUMNS..].iter_mut().zip(sums) {
                            *into += sum;
                        }
                    }
                }
            },
        );
    };
    let mut all: Vec<&mut [f64]> = products.row_blocks_mut(ROWS).collect();
    if size * size * length < MIN_PARALLEL {
        all.iter_mut().enumerate().for_each(|(tile, into)| add_rows(tile, into));
    } else {
        all.par_iter_mut().enumerate().for_each(|(tile, into)| add_rows(tile, into));
    }
}

/// A matrix of `size` rows and columns.
pub(super) fn square(size: usize) -> Result<Matrix, InputError> {
    Matrix::zeros([size; 2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::synthetic::torus_signal;

    #[test]
    fn kept_products_have_the_bits_of_new_ones() {
        let signal = torus_signal(90, 37, 2);
        let vector = |point: u32, into: &mut [f64]| {
            into.iter_mut().zip(signal.point(point as usize)).for_each(|(into, &value)| *into = f64::from(value));
        };
        let lower = |products: &Matrix| -> Vec<u64> {
            let rows = products.rows().enumerate();
            rows.flat_map(|(row, values)| values[..=row].iter().map(|value| value.to_bits())).collect()
        };
        for level in SimdLevel::available() {
            let mut kept = KeptProducts::default();
            // Points come and go, from 1 to 60 of them; all stay, none stay.
            for (from, to, step) in
                [(3, 50, 1), (0, 60, 1), (9, 51, 1), (9, 51, 1), (1, 61, 2), (60, 90, 1), (60, 61, 1)]
            {
                let points: Vec<u32> = (from..to).step_by(step).filter(|point| point % 7 != from % 5).collect();
                let found = kept.of(&points, 37, level, vector).expect("products");
                let new = KeptProducts::default().of(&points, 37, level, vector).expect("products");
                assert_eq!(lower(&found), lower(&new), "{from} to {to} by {step}");
                kept.keep(&points, found);
            }
            let many: Vec<u32> = (0..MOST_KEPT as u32 + 1).collect();
            kept.keep(&many, square(1).expect("a matrix"));
            assert!(kept.products.is_none());
        }
    }
}
