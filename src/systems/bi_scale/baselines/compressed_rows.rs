//! Compressed rows: the columns and values of each row one after another.

use super::stored::{StoredSize, StoredTransfer};
use crate::bi_scale::matrix::SparseMatrix;
use crate::error::{InputError, input_error};

/// The number of a column as a layout keeps it.
pub trait RowColumn: Copy + Send + Sync {
    /// The largest.
    const MOST: u32;
    /// The number of a column; `None` beyond [`Self::MOST`].
    fn of(column: u32) -> Option<Self>;
    /// The index into the light.
    fn place(self) -> usize;
}

/// A value as a layout keeps it.
pub trait RowValue: Copy + Send + Sync {
    /// The values that there is room for.
    const HOLDS: &'static str;
    /// The value of an entry; `None` if it is out of range.
    fn of(matrix: &SparseMatrix, entry: i32) -> Option<Self>;
    /// The value in f32; exact up to 24 bits. `unit` is that of the matrix, if it has one.
    fn single(self, unit: f32) -> f32;
}

impl RowColumn for u16 {
    const MOST: u32 = Self::MAX as u32;

    fn of(column: u32) -> Option<Self> {
        column.try_into().ok()
    }

    #[inline(always)]
    fn place(self) -> usize {
        self.into()
    }
}

impl RowColumn for u32 {
    const MOST: u32 = Self::MAX;

    fn of(column: u32) -> Option<Self> {
        Some(column)
    }

    #[inline(always)]
    fn place(self) -> usize {
        self as usize
    }
}

impl RowValue for i8 {
    const HOLDS: &'static str = "values of -128 to 127 units";

    fn of(matrix: &SparseMatrix, entry: i32) -> Option<Self> {
        matrix.values().fraction_bits()?;
        entry.try_into().ok()
    }

    #[inline(always)]
    fn single(self, unit: f32) -> f32 {
        unit * f32::from(self)
    }
}

impl RowValue for f32 {
    const HOLDS: &'static str = "values within single precision";

    fn of(matrix: &SparseMatrix, entry: i32) -> Option<Self> {
        Some(matrix.value(entry) as Self).filter(|value| value.is_finite())
    }

    #[inline(always)]
    fn single(self, _: f32) -> f32 {
        self
    }
}

/// Three bytes an entry: a column of two, and a value of one in units of the matrix.
pub type NarrowRows = CompressedRows<u16, i8>;
/// Eight bytes an entry: a column and a value of four each.
pub type WideRows = CompressedRows<u32, f32>;

/// A sparse matrix row by row, four bytes more for where each row begins (CSR).
#[derive(Clone, Debug, PartialEq)]
pub struct CompressedRows<I, V> {
    width: usize,
    unit: f32,
    begins: Vec<u32>,
    columns: Vec<I>,
    values: Vec<V>,
}

impl<I: RowColumn, V: RowValue> CompressedRows<I, V> {
    /// The rows of a matrix.
    ///
    /// # Errors
    /// [`InputError`] if the layout has no room for them.
    ///
    /// # Panics
    /// If there are more entries than 32 bits can count.
    pub fn new(matrix: &SparseMatrix) -> Result<Self, InputError> {
        assert!(u32::try_from(matrix.nonzeros()).is_ok(), "entries that 32 bits can count");
        let mut rows = Self {
            width: matrix.columns(),
            unit: matrix.values().unit() as f32,
            begins: Vec::with_capacity(matrix.rows() + 1),
            columns: Vec::with_capacity(matrix.nonzeros()),
            values: Vec::with_capacity(matrix.nonzeros()),
        };
        rows.begins.push(0);
        for row in 0..matrix.rows() {
            for entry in matrix.row(row) {
                let column = entry.index;
                rows.columns.push(I::of(column).ok_or_else(|| {
                    input_error!(
                        "expected columns of at most {} in this layout, found {column}: take one of wider numbers",
                        I::MOST
                    )
                })?);
                let value = V::of(matrix, entry.value);
                let out_of_range = || {
                    input_error!(
                        "expected {} in this layout, found {:e} in row {row}: take one of wider numbers",
                        V::HOLDS,
                        matrix.value(entry.value)
                    )
                };
                rows.values.push(value.ok_or_else(out_of_range)?);
            }
            rows.begins.push(rows.columns.len() as u32);
        }
        Ok(rows)
    }

    /// Number of entries.
    pub fn nonzeros(&self) -> usize {
        self.columns.len()
    }

    /// Rows times C lights, or channels of one, in f32: of a row one product after the other, columns increasing,
    /// beginning with 0.
    ///
    /// # Panics
    /// If the light has not as many numbers as the matrix has columns.
    pub fn multiply_singles<const C: usize>(&self, light: &[[f32; C]]) -> Vec<[f32; C]> {
        assert_eq!(light.len(), self.width, "as many numbers as columns");
        self.sums([0.0; C], |sum, column, value| {
            let light = light[column];
            std::array::from_fn(|channel| sum[channel] + value * light[channel])
        })
    }

    /// A sum per row over its entries in their order.
    #[inline(always)]
    fn sums<S: Copy>(&self, zero: S, add: impl Fn(S, usize, f32) -> S) -> Vec<S> {
        let row = |ends: &[u32]| {
            let of = ends[0] as usize..ends[1] as usize;
            let entries = self.columns[of.clone()].iter().zip(&self.values[of]);
            entries.fold(zero, |sum, (column, value)| add(sum, column.place(), value.single(self.unit)))
        };
        self.begins.windows(2).map(row).collect()
    }
}

impl<I: RowColumn, V: RowValue> StoredTransfer for CompressedRows<I, V> {
    fn sizes(&self) -> Vec<StoredSize> {
        let entry = size_of::<I>() + size_of::<V>();
        let layout = if entry == 3 { "3 bytes an entry, 4 a row" } else { "8 bytes an entry, 4 a row" };
        vec![StoredSize { layout, bytes: (entry * self.nonzeros() + 4 * self.begins.len()) as u64 }]
    }

    fn multiply(&self, light: &[f64]) -> Vec<f64> {
        assert_eq!(light.len(), self.width, "as many numbers as columns");
        self.sums(0.0, |sum, column, value| sum + f64::from(value) * light[column])
    }
}
