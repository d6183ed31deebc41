//! Lists of the entries of each row or column, and how often each value occurs in a column.

use crate::bi_scale::matrix::MatrixEntry;

/// Entries line by line, in any order.
pub(super) type Lines = Vec<Vec<MatrixEntry>>;

pub(super) fn transposed(rows: &[Vec<MatrixEntry>], width: usize) -> Lines {
    let mut columns = vec![Vec::new(); width];
    for (index, row) in (0..).zip(rows) {
        row.iter().for_each(|entry| columns[entry.index as usize].push(MatrixEntry { index, value: entry.value }));
    }
    columns
}

/// The non-zero values of one column in the rows of a submatrix, each with its count.
#[derive(Clone, Debug, Default)]
pub(super) struct ColumnTally {
    /// In no particular order; a count may have returned to 0.
    values: Vec<(i32, u32)>,
    nonzeros: u32,
    /// The highest count.
    most: u32,
}

impl ColumnTally {
    pub(super) fn add(&mut self, value: i32) {
        self.nonzeros += 1;
        let count = match self.values.iter_mut().find(|(known, _)| *known == value) {
            Some((_, count)) => {
                *count += 1;
                *count
            }
            None => {
                self.values.push((value, 1));
                1
            }
        };
        self.most = self.most.max(count);
    }

    pub(super) fn remove(&mut self, value: i32) {
        self.nonzeros -= 1;
        let known = self.values.iter_mut().find(|(known, _)| *known == value);
        known.expect("a value that was added").1 -= 1;
        self.most = self.values.iter().map(|(_, count)| *count).max().unwrap_or(0);
    }

    /// Count of the most frequent value plus number of non-zeros: half the gain, before costs, of inserting the column.
    pub(super) fn most_and_nonzeros(&self) -> u32 {
        self.most + self.nonzeros
    }

    /// Count of `value` plus number of non-zeros: half the gain of keeping a column inside.
    pub(super) fn matches_and_nonzeros(&self, value: i32) -> u32 {
        self.values.iter().find(|(known, _)| *known == value).map_or(0, |(_, count)| *count) + self.nonzeros
    }

    /// The most frequent value; on ties, the lowest. Panics if there is no value.
    pub(super) fn most_frequent(&self) -> i32 {
        let frequent = self.values.iter().filter(|(_, count)| *count == self.most && *count > 0);
        frequent.map(|(value, _)| *value).min().expect("a column with a value")
    }

    pub(super) fn clear(&mut self) {
        self.values.clear();
        (self.nonzeros, self.most) = (0, 0);
    }
}
