//! Rows of integers, most of them 0, column by column.

use serde::{Deserialize, Serialize};

/// Number of rows of a block; a byte holds the index of a row in its block.
pub const BLOCK_ROWS: usize = 256;

/// Rows of integers in blocks of [`BLOCK_ROWS`]; the last block may be shorter. For each column of a block, the
/// non-zero numbers are stored in order of rows, each with its row in the block.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SparseRows {
    rows: usize,
    columns: usize,
    /// Number of non-zero numbers of each column of each block.
    counts: Vec<u16>,
    row_in_block: Vec<u8>,
    values: Vec<i16>,
}

/// A column of a block: the rows of its non-zero numbers, and the numbers.
pub(in crate::all_frequency) type SparseColumn<'a> = (&'a [u8], &'a [i16]);

impl SparseRows {
    /// Encodes rows of `columns` numbers each, concatenated. Panics if `columns` is 0, or the last row is incomplete.
    pub fn encode(values: &[i16], columns: usize) -> Self {
        assert!(columns > 0 && values.len().is_multiple_of(columns), "whole rows");
        let mut sparse = Self { rows: values.len() / columns, columns, ..Self::default() };
        for block in values.chunks(BLOCK_ROWS * columns) {
            for column in 0..columns {
                let numbers = block.iter().skip(column).step_by(columns);
                let before = sparse.values.len();
                for (row, &value) in numbers.enumerate().filter(|(_, value)| **value != 0) {
                    sparse.row_in_block.push(row as u8);
                    sparse.values.push(value);
                }
                sparse.counts.push((sparse.values.len() - before) as u16);
            }
        }
        sparse
    }

    /// Creates rows from their parts: the number of values of each column of each block; all row numbers; all values.
    /// `None` if the parts are inconsistent: a row beyond its block or out of order, a 0 among the values, too many or
    /// too few numbers.
    pub fn from_parts(
        rows: usize,
        columns: usize,
        counts: Vec<u16>,
        row_in_block: Vec<u8>,
        values: Vec<i16>,
    ) -> Option<Self> {
        let blocks = rows.div_ceil(BLOCK_ROWS);
        let all = counts.iter().map(|&count| usize::from(count)).sum::<usize>();
        if columns == 0 || Some(counts.len()) != blocks.checked_mul(columns) {
            return None;
        }
        if row_in_block.len() != all || values.len() != all || values.contains(&0) {
            return None;
        }
        let sparse = Self { rows, columns, counts, row_in_block, values };
        let fits = sparse.blocks().enumerate().all(|(block, mut columns)| {
            let height = BLOCK_ROWS.min(rows - block * BLOCK_ROWS);
            columns.all(|(rows, _)| {
                rows.is_sorted_by(|a, b| a < b) && rows.last().is_none_or(|&last| usize::from(last) < height)
            })
        });
        fits.then_some(sparse)
    }

    /// The parts: counts, row numbers, values.
    pub fn parts(&self) -> (&[u16], &[u8], &[i16]) {
        (&self.counts, &self.row_in_block, &self.values)
    }

    /// All numbers, row by row.
    pub fn decode(&self) -> Vec<i16> {
        let mut values = vec![0; self.rows * self.columns];
        for (block, rows) in self.blocks().zip(values.chunks_mut(BLOCK_ROWS * self.columns)) {
            for (column, (of_rows, numbers)) in block.enumerate() {
                for (&row, &value) in of_rows.iter().zip(numbers) {
                    rows[usize::from(row) * self.columns + column] = value;
                }
            }
        }
        values
    }

    /// The columns of each block.
    pub(in crate::all_frequency) fn blocks(&self) -> impl Iterator<Item = impl Iterator<Item = SparseColumn<'_>>> {
        let mut end = 0;
        self.counts.chunks(self.columns.max(1)).map(move |counts| {
            let mut at = end;
            end += counts.iter().map(|&count| usize::from(count)).sum::<usize>();
            counts.iter().map(move |&count| {
                let range = at..at + usize::from(count);
                at = range.end;
                (&self.row_in_block[range.clone()], &self.values[range])
            })
        })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Numbers per row.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of blocks.
    pub fn block_count(&self) -> usize {
        self.rows.div_ceil(BLOCK_ROWS)
    }

    /// Number of non-zero numbers.
    pub fn nonzeros(&self) -> usize {
        self.values.len()
    }
}
