//! Compressed rows: the columns and values of each row one after another.

use super::stored::{StoredSize, StoredTransfer};
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::product::by_rows;

/// A sparse matrix row by row, four bytes more for where each row begins (CSR).
#[derive(Clone, Copy, Debug)]
pub struct CompressedRows<'a> {
    matrix: &'a SparseMatrix,
    layout: &'static str,
    entry_bytes: u64,
}

impl<'a> CompressedRows<'a> {
    /// Three bytes an entry: a column of two, and a value of one in units of the matrix. `None` if the layout has no
    /// room for the columns or the values.
    pub fn narrow(matrix: &'a SparseMatrix) -> Option<Self> {
        let fits = |row: usize| matrix.row(row).iter().all(|entry| i8::try_from(entry.value).is_ok());
        let has_room = matrix.columns() <= 1 << 16 && (0..matrix.rows()).all(fits);
        has_room.then_some(Self { matrix, layout: "3 bytes an entry, 4 a row", entry_bytes: 3 })
    }

    /// Eight bytes an entry: a column and a value of four each.
    pub fn wide(matrix: &'a SparseMatrix) -> Self {
        Self { matrix, layout: "8 bytes an entry, 4 a row", entry_bytes: 8 }
    }
}

impl StoredTransfer for CompressedRows<'_> {
    fn sizes(&self) -> Vec<StoredSize> {
        let [entries, rows] = [self.matrix.nonzeros(), self.matrix.rows()].map(|count| count as u64);
        vec![StoredSize { layout: self.layout, bytes: self.entry_bytes * entries + 4 * (rows + 1) }]
    }

    fn multiply(&self, light: &[f64]) -> Vec<f64> {
        by_rows(self.matrix, light)
    }
}
