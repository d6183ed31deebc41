//! Biclusters as one of the storage methods that are compared.

use super::stored::{StoredSize, StoredTransfer};
use crate::bi_scale::bicluster::Biclustering;
use crate::bi_scale::product;

/// Bytes of a row number, and of a column's number and value, which agree with the paper's sizes.
const PER_ROW: usize = 4;
const PER_COLUMN: usize = 8;

impl StoredTransfer for Biclustering {
    fn sizes(&self) -> Vec<StoredSize> {
        let bytes = (PER_ROW * self.row_entries() + PER_COLUMN * self.column_entries()) as u64;
        vec![StoredSize { layout: "4 bytes a row, 8 a column", bytes }]
    }

    fn multiply(&self, light: &[f64]) -> Vec<f64> {
        product::reference(self, light)
    }
}
