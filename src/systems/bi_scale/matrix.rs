//! The transfer matrix T: sparse, with integer values in units of a power of two.
//!
//! Averaging 2^m x 2^m visibility samples gives multiples of 2^-2m (section IV-A). As integers they are subtracted
//! without rounding, so that "lossless" means equal.

use thiserror::Error;

use crate::io::CoordinateMatrix;

const TWO_TO_63: f64 = 9_223_372_036_854_775_808.0;

/// An entry of a row or column: its index along the line, and its value in units of the matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MatrixEntry {
    /// The column of an entry of a row; the row of an entry of a column.
    pub index: u32,
    /// The value in units of [`SparseMatrix::unit`].
    pub value: i32,
}

/// A sparse matrix, row by row. Columns increase along a row; no value is 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SparseMatrix {
    columns: usize,
    fraction_bits: u32,
    begins: Vec<usize>,
    entries: Vec<MatrixEntry>,
}

/// Reasons for which entries make no matrix. Rows and columns count from 0.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum SparseMatrixError {
    /// No rows or columns, or more than 32 bits can count.
    #[error("expected 1 to {} rows and columns, found {rows} x {columns}", u32::MAX)]
    Size { rows: usize, columns: usize },
    /// A column outside the matrix.
    #[error("expected a column below {columns} in row {row}, found {column}")]
    Column { row: usize, column: u32, columns: usize },
    /// Entries out of order, or two with the same row and column.
    #[error("expected increasing columns in row {row}, found {column} after {before}: is an entry given twice?")]
    Order { row: usize, column: u32, before: u32 },
    /// A value of 0.
    #[error("expected values other than 0, found 0 in row {row}, column {column}")]
    Zero { row: usize, column: u32 },
    /// A value that is no multiple of 2^-[`SparseMatrix::MOST_FRACTION_BITS`].
    #[error(
        "expected multiples of 2^-{} in row {row}, column {column} (counted from 0), found {value}: residuals are \
         exact for these alone",
        SparseMatrix::MOST_FRACTION_BITS
    )]
    Fraction { row: u32, column: u32, value: f64 },
    /// A value that does not fit 32 bits in the units of the matrix.
    #[error(
        "expected values that 32 bits hold in units of 2^-{bits}, the finest among them; found {value} in row {row}, \
         column {column} (counted from 0)"
    )]
    Range { row: u32, column: u32, value: f64, bits: u32 },
}

impl SparseMatrix {
    /// The largest number of fraction bits: more than the difference of two f32 numbers in [0, 1] needs.
    pub const MOST_FRACTION_BITS: u32 = 30;

    /// A matrix without rows yet, with `columns` columns and units of 2^-`fraction_bits`.
    ///
    /// # Errors
    /// [`SparseMatrixError::Size`] for 0 columns, or more than 32 bits can count.
    ///
    /// # Panics
    /// If `fraction_bits` exceeds [`Self::MOST_FRACTION_BITS`].
    pub fn new(columns: usize, fraction_bits: u32) -> Result<Self, SparseMatrixError> {
        assert!(fraction_bits <= Self::MOST_FRACTION_BITS, "a unit of 2^-30 or more, not 2^-{fraction_bits}");
        if columns == 0 || u32::try_from(columns).is_err() {
            return Err(SparseMatrixError::Size { rows: 0, columns });
        }
        Ok(Self { columns, fraction_bits, begins: vec![0], entries: Vec::new() })
    }

    /// A matrix of real numbers, in the largest power-of-two unit of which all are multiples. Zeros are left out.
    ///
    /// # Errors
    /// [`SparseMatrixError`] if there is no such unit, or its multiples do not fit 32 bits.
    pub fn from_coordinates(matrix: &CoordinateMatrix) -> Result<Self, SparseMatrixError> {
        let finest = f64::from(1_u32 << Self::MOST_FRACTION_BITS);
        let mut fraction_bits = 0;
        for &(row, column, value) in &matrix.entries {
            // Exact: the factor is a power of two, and integers are far from both ends of the exponent range.
            let scaled = value * finest;
            if scaled.fract() != 0.0 {
                return Err(SparseMatrixError::Fraction { row, column, value });
            }
            // Numbers beyond 64 bits are refused below, in any unit.
            let zeros = if scaled.abs() < TWO_TO_63 { (scaled as i64).trailing_zeros() } else { 64 };
            fraction_bits = fraction_bits.max(Self::MOST_FRACTION_BITS.saturating_sub(zeros));
        }
        let mut sparse = Self::new(matrix.columns, fraction_bits)?;
        let mut rows = matrix.entries.chunk_by(|a, b| a.0 == b.0).peekable();
        let mut row = Vec::new();
        for number in 0..matrix.rows {
            row.clear();
            for &(_, index, value) in rows.next_if(|entries| entries[0].0 as usize == number).unwrap_or_default() {
                let units = value * f64::from(1_u32 << fraction_bits);
                if units.abs() > f64::from(i32::MAX) {
                    let row = number as u32;
                    return Err(SparseMatrixError::Range { row, column: index, value, bits: fraction_bits });
                }
                if units != 0.0 {
                    row.push(MatrixEntry { index, value: units as i32 });
                }
            }
            sparse.push_row(&row)?;
        }
        Ok(sparse)
    }

    /// Appends a row.
    ///
    /// # Errors
    /// [`SparseMatrixError`]; the matrix is then unchanged.
    pub fn push_row(&mut self, row: &[MatrixEntry]) -> Result<(), SparseMatrixError> {
        let (number, columns) = (self.rows(), self.columns);
        if u32::try_from(number + 1).is_err() {
            return Err(SparseMatrixError::Size { rows: number + 1, columns });
        }
        let mut before = None;
        for &MatrixEntry { index: column, value } in row {
            match before {
                _ if column as usize >= columns => {
                    return Err(SparseMatrixError::Column { row: number, column, columns });
                }
                Some(before) if before >= column => {
                    return Err(SparseMatrixError::Order { row: number, column, before });
                }
                _ if value == 0 => return Err(SparseMatrixError::Zero { row: number, column }),
                _ => before = Some(column),
            }
        }
        self.entries.extend_from_slice(row);
        self.begins.push(self.entries.len());
        Ok(())
    }

    /// Number of rows: for a transfer matrix M n, the local directions of all n vertices.
    pub fn rows(&self) -> usize {
        self.begins.len() - 1
    }

    /// Number of columns: for a transfer matrix N, the light texels.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of fraction bits of the values.
    pub fn fraction_bits(&self) -> u32 {
        self.fraction_bits
    }

    /// The unit of the integer values: 2^-`fraction_bits`.
    pub fn unit(&self) -> f64 {
        1.0 / f64::from(1_u32 << self.fraction_bits)
    }

    /// Number of entries: nnz(T).
    pub fn nonzeros(&self) -> usize {
        self.entries.len()
    }

    /// The entries of a row, with increasing columns.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row(&self, row: usize) -> &[MatrixEntry] {
        &self.entries[self.begins[row]..self.begins[row + 1]]
    }

    /// All entries row by row, and the start of each row followed by the end of the last.
    pub(super) fn to_rows(&self) -> (Vec<MatrixEntry>, Vec<usize>) {
        (self.entries.clone(), self.begins.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_row_changes_nothing() {
        let entry = |index, value| MatrixEntry { index, value };
        let mut matrix = SparseMatrix::new(4, 2).unwrap();
        matrix.push_row(&[entry(0, 4), entry(3, 1)]).unwrap();
        let before = matrix.clone();
        let wrong = [
            (vec![entry(4, 1)], SparseMatrixError::Column { row: 1, column: 4, columns: 4 }),
            (vec![entry(2, 1), entry(2, 3)], SparseMatrixError::Order { row: 1, column: 2, before: 2 }),
            (vec![entry(1, 0)], SparseMatrixError::Zero { row: 1, column: 1 }),
        ];
        for (row, error) in wrong {
            assert_eq!(matrix.push_row(&row), Err(error));
            assert_eq!(matrix, before);
        }
        assert_eq!(SparseMatrix::new(0, 2), Err(SparseMatrixError::Size { rows: 0, columns: 0 }));
        assert_eq!((matrix.unit(), matrix.nonzeros()), (0.25, 2));
    }

    #[test]
    fn real_numbers_get_the_largest_units() {
        let of = |entries: &[(u32, u32, f64)]| {
            SparseMatrix::from_coordinates(&CoordinateMatrix { rows: 3, columns: 4, entries: entries.to_vec() })
        };
        let matrix = of(&[(0, 1, 0.5), (2, 0, -3.0), (2, 1, 0.0), (2, 3, 0.25)]).unwrap();
        assert_eq!((matrix.fraction_bits(), matrix.nonzeros(), matrix.rows()), (2, 3, 3));
        assert_eq!(matrix.row(2), [MatrixEntry { index: 0, value: -12 }, MatrixEntry { index: 3, value: 1 }]);
        assert_eq!(of(&[(0, 1, 6e8)]).unwrap().fraction_bits(), 0);
        assert_eq!(of(&[(1, 1, 0.1)]), Err(SparseMatrixError::Fraction { row: 1, column: 1, value: 0.1 }));
        let range = |value, bits| Err(SparseMatrixError::Range { row: 0, column: 0, value, bits });
        assert_eq!(of(&[(0, 0, 6e8), (0, 1, 0.25)]), range(6e8, 2));
        assert_eq!(of(&[(0, 0, 1e200)]), range(1e200, 0));
    }
}
