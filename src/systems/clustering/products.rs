//! Inner products, most of the work of compression, in blocks that stay in registers; and inner products of all pairs
//! of a cluster's points.

use std::hint::black_box;

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use crate::error::InputError;
use crate::linalg::{Matrix, dot, make_largest_positive};

/// Rows of a block.
pub(super) const ROWS: usize = 6;

/// Vectors side by side, component by component: component j of vector v is `[v / N][j][v % N]`. Missing vectors of
/// the last group are 0.
#[derive(Clone, Debug)]
pub(super) struct Packed<const N: usize> {
    length: usize,
    components: Vec<[f64; N]>,
}

impl<const N: usize> Packed<N> {
    /// Packs `count` vectors of `length` numbers; `vector` writes one of them.
    pub(super) fn new(count: usize, length: usize, mut vector: impl FnMut(usize, &mut [f64])) -> Self {
        let mut components = Vec::with_capacity(count.div_ceil(N) * length);
        let mut group = vec![0.0; N * length];
        for first in (0..count).step_by(N) {
            let here = N.min(count - first);
            for (at, into) in group.chunks_exact_mut(length.max(1)).take(here).enumerate() {
                vector(first + at, into);
            }
            group[here * length..].fill(0.0);
            components.extend((0..length).map(|j| std::array::from_fn(|v| group[v * length + j])));
        }
        Self { length, components }
    }

    /// Packs the transpose: component j of vector `at` is element `at` of source vector j. `part` fills its slice with
    /// elements of source vector j from `at` on.
    pub(super) fn across(count: usize, length: usize, mut part: impl FnMut(usize, usize, &mut [f64])) -> Self {
        let mut components = vec![[0.0; N]; count.div_ceil(N) * length];
        for j in 0..length {
            for first in (0..count).step_by(N) {
                part(j, first, &mut components[first / N * length + j][..N.min(count - first)]);
            }
        }
        Self { length, components }
    }

    pub(super) fn groups(&self) -> impl ExactSizeIterator<Item = &[[f64; N]]> {
        self.components.chunks_exact(self.length.max(1))
    }
}

/// Adds the inner products of ROWS vectors with N others. Each sum runs over the components in order, from 0.
#[inline(always)]
pub(super) fn add_block<const N: usize>(rows: &[[f64; ROWS]], columns: &[[f64; N]], into: &mut [[f64; N]; ROWS]) {
    let [mut a, mut b, mut c, mut d, mut e, mut f] = [[0.0; N]; ROWS];
    for (row, column) in rows.iter().zip(columns) {
        a = add_scaled(a, row[0], column);
        b = add_scaled(b, row[1], column);
        c = add_scaled(c, row[2], column);
        d = add_scaled(d, row[3], column);
        e = add_scaled(e, row[4], column);
        f = add_scaled(f, row[5], column);
    }
    // `black_box` hides the use of the sums, which would change their registers.
    let sums = black_box([a, b, c, d, e, f]);
    for (into, sums) in into.iter_mut().zip(&sums) {
        *into = std::array::from_fn(|at| into[at] + sums[at]);
    }
}

#[inline(always)]
fn add_scaled<const N: usize>(sums: [f64; N], scale: f64, others: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|at| sums[at] + scale * others[at])
}

/// Number of vectors whose inner products are computed in parallel.
const SIDE: usize = 4;
/// Number of partial sums of an inner product, as in [`dot`].
const PARTIAL: usize = 8;

/// Calls `into` with the inner product of a vector and each of `others`, with the bits of [`dot`].
#[inline(always)]
pub(super) fn dots(others: &[f64], vector: &[f64], mut into: impl FnMut(f64)) {
    let length = vector.len().max(1);
    let (values, rest) = vector.as_chunks::<PARTIAL>();
    let mut groups = others.chunks_exact(SIDE * length);
    for group in &mut groups {
        let [mut a, mut b, mut c, mut d] = [[0.0; PARTIAL]; SIDE];
        let others: [_; SIDE] = std::array::from_fn(|i| group[i * length..][..length].as_chunks::<PARTIAL>());
        let [(p, _), (q, _), (r, _), (s, _)] = others;
        for ((((values, p), q), r), s) in values.iter().zip(p).zip(q).zip(r).zip(s) {
            a = add_terms(a, p, values);
            b = add_terms(b, q, values);
            c = add_terms(c, r, values);
            d = add_terms(d, s, values);
        }
        for (mut sums, (_, other)) in [a, b, c, d].into_iter().zip(others) {
            sums.iter_mut().zip(other.iter().zip(rest)).for_each(|(sum, (x, y))| *sum += x * y);
            into(folded(sums));
        }
    }
    groups.remainder().chunks_exact(length).for_each(|other| into(dot(other, vector)));
}

/// Adds partial sums in the order of [`dot`].
#[inline(always)]
fn folded([s0, s1, s2, s3, s4, s5, s6, s7]: [f64; PARTIAL]) -> f64 {
    ((s0 + s4) + (s2 + s6)) + ((s1 + s5) + (s3 + s7))
}

#[inline(always)]
fn add_terms(sums: [f64; PARTIAL], a: &[f64; PARTIAL], b: &[f64; PARTIAL]) -> [f64; PARTIAL] {
    std::array::from_fn(|at| sums[at] + a[at] * b[at])
}

/// Orthonormalises a vector against orthonormal vectors and appends it; it is orthogonalised twice, because of
/// rounding. Returns false, without appending, if its remainder is at most `nothing` long.
#[inline(always)]
pub(super) fn add_orthonormal(vectors: &mut Vec<f64>, mut vector: Vec<f64>, nothing: f64) -> bool {
    for _ in 0..2 {
        for earlier in vectors.chunks_exact(vector.len()) {
            let along = dot(earlier, &vector);
            vector.iter_mut().zip(earlier).for_each(|(value, earlier)| *value -= along * earlier);
        }
        let length = dot(&vector, &vector).sqrt();
        if length <= nothing {
            return false;
        }
        vector.iter_mut().for_each(|value| *value /= length);
    }
    make_largest_positive(&mut vector);
    vectors.extend(vector);
    true
}

/// Columns of a block.
pub(super) const COLUMNS: usize = 8;
/// One thread computes products of fewer numbers than this.
const MIN_PARALLEL: usize = 1 << 22;
/// Maximum number of points of a cluster whose products are kept: 2 MiB.
const MOST_KEPT: usize = 512;

/// Inner products of a cluster's points, kept from one fit to the next; only inner products of new points are computed.
/// Each sum is independent of the other points, so that reuse changes no bits.
#[derive(Clone, Debug, Default)]
pub(super) struct KeptProducts {
    points: Vec<u32>,
    /// The lower triangle.
    products: Option<Matrix>,
}

impl KeptProducts {
    /// The inner products of points, in increasing order: the lower triangle. `vector` writes a point's numbers.
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

    /// Keeps the products of these points, unless there are too many points.
    pub(super) fn keep(&mut self, points: &[u32], products: Matrix) {
        *self = Self::default();
        if points.len() <= MOST_KEPT {
            (self.points, self.products) = (points.to_vec(), Some(products));
        }
    }
}

/// Adds the products of all pairs of vectors, packed both as `rows` and as `columns`, to the lower triangle; the upper
/// part is not used.
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

pub(super) fn square(size: usize) -> Result<Matrix, InputError> {
    Matrix::zeros([size; 2])
}
