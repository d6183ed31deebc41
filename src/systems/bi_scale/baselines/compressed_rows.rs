//! Compressed sparse rows: columns and values of each row.

use super::stored::{StoredSize, StoredTransfer};
use crate::bi_scale::matrix::SparseMatrix;
use crate::error::{InputError, ensure};

/// A sparse matrix in compressed sparse row format (CSR), with four bytes for the start of each row. Products are in
/// f32 or f64; both layouts store the same numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct CompressedRows {
    /// Bytes per entry: 3 or 8.
    entry: usize,
    width: usize,
    begins: Vec<u32>,
    columns: Vec<u32>,
    /// Values, exact up to 24 bits.
    values: Vec<f32>,
}

impl CompressedRows {
    /// Stores three bytes per entry: two for the column, and one for the value in units of the matrix. Fails with
    /// [`InputError`] if a column or value does not fit. Panics if there are more entries than 32 bits can count.
    pub fn narrow(matrix: &SparseMatrix) -> Result<Self, InputError> {
        let has_unit = matrix.values().fraction_bits().is_some();
        let fits = |entry: i32| has_unit && i8::try_from(entry).is_ok();
        Self::new(matrix, 3, u16::MAX.into(), "values of -128 to 127 units", fits)
    }

    /// Stores eight bytes per entry: four for the column, and four for the value in f32. Fails with [`InputError`] if a
    /// value is beyond single precision. Panics as [`Self::narrow`] does.
    pub fn wide(matrix: &SparseMatrix) -> Result<Self, InputError> {
        let fits = |entry| (matrix.value(entry) as f32).is_finite();
        Self::new(matrix, 8, u32::MAX, "values within single precision", fits)
    }

    fn new(
        matrix: &SparseMatrix,
        entry_bytes: usize,
        most: u32,
        holds: &str,
        fits: impl Fn(i32) -> bool,
    ) -> Result<Self, InputError> {
        assert!(u32::try_from(matrix.nonzeros()).is_ok(), "entries that 32 bits can count");
        let (begins, columns, values) = (vec![0], Vec::new(), Vec::new());
        let mut rows = Self { entry: entry_bytes, width: matrix.columns(), begins, columns, values };
        for row in 0..matrix.rows() {
            for entry in matrix.row(row) {
                let (column, value) = (entry.index, matrix.value(entry.value));
                ensure!(
                    column <= most,
                    "expected columns of at most {most} in this layout, found {column}: take one of wider numbers"
                );
                ensure!(
                    fits(entry.value),
                    "expected {holds} in this layout, found {value:e} in row {row}: take one of wider numbers"
                );
                rows.columns.push(column);
                rows.values.push(value as f32);
            }
            rows.begins.push(rows.columns.len() as u32);
        }
        Ok(rows)
    }

    /// Number of entries.
    pub fn nonzeros(&self) -> usize {
        self.columns.len()
    }

    /// Multiplies rows by C lights, or channels of one light, in f32. The products of a row are added to 0 in the order
    /// of columns. Panics if the light does not have one number per column.
    pub fn multiply_singles<const C: usize>(&self, light: &[[f32; C]]) -> Vec<[f32; C]> {
        assert_eq!(light.len(), self.width, "as many numbers as columns");
        self.sums([0.0; C], |sum, column, value| {
            let light = light[column];
            std::array::from_fn(|channel| sum[channel] + value * light[channel])
        })
    }

    /// Sums each row's entries in their order.
    #[inline(always)]
    fn sums<S: Copy>(&self, zero: S, add: impl Fn(S, usize, f32) -> S) -> Vec<S> {
        let row = |ends: &[u32]| {
            let of = ends[0] as usize..ends[1] as usize;
            let entries = self.columns[of.clone()].iter().zip(&self.values[of]);
            entries.fold(zero, |sum, (&column, &value)| add(sum, column as usize, value))
        };
        self.begins.windows(2).map(row).collect()
    }
}

impl StoredTransfer for CompressedRows {
    fn sizes(&self) -> Vec<StoredSize> {
        let layout = if self.entry == 3 { "3 bytes per entry, 4 per row" } else { "8 bytes per entry, 4 per row" };
        vec![StoredSize { layout, bytes: (self.entry * self.nonzeros() + 4 * self.begins.len()) as u64 }]
    }

    fn multiply(&self, light: &[f64]) -> Vec<f64> {
        assert_eq!(light.len(), self.width, "as many numbers as columns");
        self.sums(0.0, |sum, column, value| sum + f64::from(value) * light[column])
    }
}
