//! Random choice of the elements at which biclusters start.

use crate::geom::random::CounterRng;

/// The start element of a bicluster, by its index among the non-zeros row by row: uniformly one of `count`.
pub(super) fn start(seed: u64, bicluster: u64, count: u64) -> u64 {
    let bits = CounterRng::new(seed).bits(bicluster, 0, 0);
    ((u128::from(bits) * u128::from(count)) >> 64) as u64
}

/// Numbers of elements per row, with the sums that find the row of an element by its number (Fenwick 1994).
#[derive(Clone, Debug)]
pub(super) struct Counts {
    /// Node i, from 1, holds the sum of the i & -i rows that end with row i - 1.
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

    /// Elements in all rows.
    pub(super) fn total(&self) -> u64 {
        self.total
    }

    /// Adds elements to a row, or takes some away.
    pub(super) fn add(&mut self, row: usize, more: i64) {
        self.total = self.total.wrapping_add_signed(more);
        let mut node = row + 1;
        while node < self.sums.len() {
            self.sums[node] = self.sums[node].wrapping_add_signed(more);
            node += node & node.wrapping_neg();
        }
    }

    /// The row of an element, and the element's number within the row.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_found() {
        let mut of_row = [3_u64, 0, 1, 0, 0, 7, 2];
        let mut counts = Counts::new(of_row.into_iter());
        for change in [(5, -7), (1, 2), (6, 1), (0, -1)] {
            let all = of_row.iter().enumerate().flat_map(|(row, &count)| (0..count).map(move |within| (row, within)));
            let found = (0..counts.total()).map(|element| counts.find(element));
            assert!(all.eq(found), "{of_row:?}");
            of_row[change.0] = of_row[change.0].wrapping_add_signed(change.1);
            counts.add(change.0, change.1);
        }
    }

    #[test]
    fn every_element_is_drawn_alike() {
        let mut drawn = [0; 10];
        (0..10_000).for_each(|number| drawn[start(5, number, 10) as usize] += 1);
        assert!(drawn.iter().all(|count| (900..1100).contains(count)), "{drawn:?}");
    }
}
