//! Many inner products at once, in blocks that stay in registers: the work of compression.

use std::hint::black_box;

use crate::linalg::{dot, make_largest_positive};

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
    /// `count` vectors of a length; `vector` writes one.
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

    /// The other way round: `count` vectors of which component j is number `at` of vector j of others. `part` writes
    /// numbers of vector j from `at` on, as many as it is given.
    pub(super) fn across(count: usize, length: usize, mut part: impl FnMut(usize, usize, &mut [f64])) -> Self {
        let mut components = vec![[0.0; N]; count.div_ceil(N) * length];
        for j in 0..length {
            for first in (0..count).step_by(N) {
                part(j, first, &mut components[first / N * length + j][..N.min(count - first)]);
            }
        }
        Self { length, components }
    }

    /// The groups of N vectors.
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
    // Hidden, or what becomes of the sums may decide how they stand in registers.
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
/// Partial sums of an inner product: those of [`dot`].
const PARTIAL: usize = 8;

/// Calls `into` with the inner products of a vector with others, as long as it each and one after another. They have
/// the bits of [`dot`].
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
            a = add_products(a, p, values);
            b = add_products(b, q, values);
            c = add_products(c, r, values);
            d = add_products(d, s, values);
        }
        for (mut sums, (_, other)) in [a, b, c, d].into_iter().zip(others) {
            sums.iter_mut().zip(other.iter().zip(rest)).for_each(|(sum, (x, y))| *sum += x * y);
            into(folded(sums));
        }
    }
    groups.remainder().chunks_exact(length).for_each(|other| into(dot(other, vector)));
}

/// The sum of partial sums, as [`dot`] folds them.
#[inline(always)]
fn folded([s0, s1, s2, s3, s4, s5, s6, s7]: [f64; PARTIAL]) -> f64 {
    ((s0 + s4) + (s2 + s6)) + ((s1 + s5) + (s3 + s7))
}

#[inline(always)]
fn add_products(sums: [f64; PARTIAL], a: &[f64; PARTIAL], b: &[f64; PARTIAL]) -> [f64; PARTIAL] {
    std::array::from_fn(|at| sums[at] + a[at] * b[at])
}

/// Appends a vector to orthonormal ones after orthogonalising it, twice against rounding, and scaling it to length 1.
/// Returns false, without appending, if no more than the length `nothing` remains of it.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_plain_loops() {
        let vector = |at: usize, into: &mut [f64]| {
            into.iter_mut().enumerate().for_each(|(j, value)| *value = ((at * 7 + j * 3) % 11) as f64);
        };
        let (rows, columns) = (Packed::<ROWS>::new(8, 5, vector), Packed::<4>::new(9, 5, vector));
        for (i, row) in rows.groups().enumerate() {
            for (j, column) in columns.groups().enumerate() {
                let mut sums = [[0.0; 4]; ROWS];
                add_block(row, column, &mut sums);
                for (a, sums) in sums.iter().enumerate() {
                    for (b, sum) in sums.iter().enumerate() {
                        let (a, b) = (i * ROWS + a, j * 4 + b);
                        let term = |k: usize| ((a * 7 + k * 3) % 11 * ((b * 7 + k * 3) % 11)) as f64;
                        let expected = if a < 8 && b < 9 { (0..5).map(term).sum::<f64>() } else { 0.0 };
                        assert_eq!(*sum, expected);
                    }
                }
            }
        }
    }

    #[test]
    fn vectors_are_packed_either_way() {
        for (count, length) in [(1, 1), (4, 3), (9, 5), (0, 2), (3, 0)] {
            let value = |vector: usize, j: usize| (vector * 31 + j) as f64;
            let packed = Packed::<4>::new(count, length, |vector, into| {
                into.iter_mut().enumerate().for_each(|(j, into)| *into = value(vector, j));
            });
            let across = Packed::<4>::across(count, length, |j, first, into| {
                into.iter_mut().enumerate().for_each(|(at, into)| *into = value(first + at, j));
            });
            assert_eq!(packed.components, across.components);
            assert_eq!(packed.components.len(), count.div_ceil(4) * length);
            for (at, values) in packed.components.iter().enumerate() {
                let vectors = at / length.max(1) * 4..;
                let expected = vectors.map(|vector| if vector < count { value(vector, at % length) } else { 0.0 });
                assert!(values.iter().copied().eq(expected.take(4)));
            }
        }
    }

    #[test]
    fn inner_products_side_by_side_have_the_bits_of_others() {
        for length in [1, 7, 8, 29, 64] {
            for count in 0..10 {
                let value = |at: usize| (at as f64 * 0.37).fract() - 0.4;
                let others: Vec<f64> = (0..count * length).map(value).collect();
                let (vector, mut found) = ((0..length).map(|at| value(at * at)).collect::<Vec<_>>(), Vec::new());
                dots(&others, &vector, |product| found.push(product));
                let expected: Vec<f64> = others.chunks_exact(length).map(|other| dot(other, &vector)).collect();
                assert_eq!(found, expected, "{count} of {length}");
            }
        }
    }

    #[test]
    fn vectors_become_orthonormal_unless_nothing_is_left() {
        let mut vectors = Vec::new();
        assert!(add_orthonormal(&mut vectors, vec![0.0, -3.0, 0.0], 0.0));
        assert!(!add_orthonormal(&mut vectors, vec![0.0, 5.0, 1e-12], 1e-9));
        assert!(!add_orthonormal(&mut vectors, vec![0.0, 5.0, 0.0], 0.0));
        assert!(add_orthonormal(&mut vectors, vec![0.0, 5.0, 1e-12], 0.0));
        assert_eq!(vectors, [0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    }
}
