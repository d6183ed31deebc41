//! Many inner products at once, in blocks that stay in registers: the work of compression.

use std::ops::{Add, Mul};

/// Rows of a block.
pub(super) const ROWS: usize = 6;

/// Vectors side by side, component by component: component j of vector v is `[v / N][j][v % N]`. Missing vectors of
/// the last group are 0.
#[derive(Clone, Debug)]
pub(super) struct Packed<T, const N: usize> {
    length: usize,
    components: Vec<[T; N]>,
}

impl<T: Copy + Default, const N: usize> Packed<T, N> {
    /// `count` vectors of a length; `vector` writes one.
    pub(super) fn new(count: usize, length: usize, mut vector: impl FnMut(usize, &mut [T])) -> Self {
        let mut components = vec![[T::default(); N]; count.div_ceil(N) * length];
        let mut one = vec![T::default(); length];
        for at in 0..count {
            vector(at, &mut one);
            let group = &mut components[at / N * length..][..length];
            group.iter_mut().zip(&one).for_each(|(into, &value)| into[at % N] = value);
        }
        Self { length, components }
    }

    /// The groups of N vectors.
    pub(super) fn groups(&self) -> impl ExactSizeIterator<Item = &[[T; N]]> {
        self.components.chunks_exact(self.length.max(1))
    }
}

/// Adds the inner products of ROWS vectors with N others. Each sum runs over the components in order, from 0.
#[inline(always)]
pub(super) fn add_block<T, const N: usize>(rows: &[[T; ROWS]], columns: &[[T; N]], into: &mut [[T; N]; ROWS])
where
    T: Copy + Default + Add<Output = T> + Mul<Output = T>,
{
    let mut sums = [[T::default(); N]; ROWS];
    for (row, column) in rows.iter().zip(columns) {
        for (sum, &value) in sums.iter_mut().zip(row) {
            for (sum, &other) in sum.iter_mut().zip(column) {
                *sum = *sum + value * other;
            }
        }
    }
    for (into, sums) in into.iter_mut().zip(&sums) {
        for (into, &sum) in into.iter_mut().zip(sums) {
            *into = *into + sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_plain_loops() {
        let vector = |at: usize, into: &mut [f64]| {
            into.iter_mut().enumerate().for_each(|(j, value)| *value = ((at * 7 + j * 3) % 11) as f64);
        };
        let (rows, columns) = (Packed::<f64, ROWS>::new(8, 5, vector), Packed::<f64, 4>::new(9, 5, vector));
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
}
