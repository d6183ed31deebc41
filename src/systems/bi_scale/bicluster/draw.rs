//! Random choice of the elements at which biclusters start.

use crate::geom::random::CounterRng;

/// The random seed of all studies.
pub const SEED: u64 = 1;

/// Chooses the start element of a bicluster uniformly among `count` non-zeros; returns its index, counted row by row.
pub(in crate::bi_scale) fn start(seed: u64, bicluster: u64, count: u64) -> u64 {
    let bits = CounterRng::new(seed).bits(bicluster, 0, 0);
    ((u128::from(bits) * u128::from(count)) >> 64) as u64
}

/// Numbers of elements per row, with a Fenwick tree (1994) that finds the row of an element by its index.
#[derive(Clone, Debug)]
pub(super) struct Counts {
    /// Nodes of the Fenwick tree, counted from 1: node i is the sum of `i & -i` rows, the last of which is row i - 1.
    sums: Vec<u64>,
    total: u64,
}

impl Counts {
    pub(super) fn new(of_row: impl ExactSizeIterator<Item = u64>) -> Self {
        let mut sums = Vec::with_capacity(of_row.len() + 1);
        sums.push(0);
        sums.extend(of_row);
        let total = sums.iter().sum();
        for node in 1..sums.len() {
            let parent = node + (node & node.wrapping_neg());
            if parent < sums.len() {
                sums[parent] += sums[node];
            }
        }
        Self { sums, total }
    }

    pub(super) fn total(&self) -> u64 {
        self.total
    }

    pub(super) fn add(&mut self, row: usize, more: i64) {
        self.total = self.total.wrapping_add_signed(more);
        let mut node = row + 1;
        while node < self.sums.len() {
            self.sums[node] = self.sums[node].wrapping_add_signed(more);
            node += node & node.wrapping_neg();
        }
    }

    /// The row of an element, and the element's index within the row.
    pub(super) fn find(&self, mut element: u64) -> (usize, u64) {
        let mut before = 0;
        let mut step = self.sums.len().next_power_of_two();
        while step > 0 {
            if let Some(&sum) = self.sums.get(before + step).filter(|sum| **sum <= element) {
                before += step;
                element -= sum;
            }
            step /= 2;
        }
        (before, element)
    }
}
