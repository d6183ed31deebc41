//! Sparse matrices: the transfer matrix T, or any matrix of multiples of a power of two.
//!
//! Averaging 2^m x 2^m visibility samples gives multiples of 2^-2m (section IV-A), which entries hold as integers
//! ([`ValueUnit`]). Multiples of a unit are subtracted without rounding, so that "lossless" means equal.

use super::unit::ValueUnit;
use crate::error::{InputError, input_error};
use crate::io::CoordinateMatrix;

/// An entry of a row or column: its index along the line, and its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MatrixEntry {
    /// The column of an entry of a row; the row of an entry of a column.
    pub index: u32,
    /// The value in units of the matrix.
    pub value: i32,
}

/// A sparse matrix, row by row. Columns increase along a row; no value is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseMatrix {
    columns: usize,
    unit: ValueUnit,
    begins: Vec<usize>,
    entries: Vec<MatrixEntry>,
}

pub(super) fn size_error(rows: usize, columns: usize) -> InputError {
    input_error!("expected 1 to {} rows and columns, found {rows} x {columns}", u32::MAX)
}

impl SparseMatrix {
    /// A matrix without rows yet, with `columns` columns and values in units of 2^-`fraction_bits`.
    ///
    /// # Errors
    /// [`InputError`] for 0 columns, or more than 32 bits can count.
    ///
    /// # Panics
    /// If `fraction_bits` exceeds [`ValueUnit::MOST_FRACTION_BITS`].
    pub fn new(columns: usize, fraction_bits: u32) -> Result<Self, InputError> {
        Self::of_unit(columns, ValueUnit::new(fraction_bits))
    }

    /// The same for a unit.
    pub(super) fn of_unit(columns: usize, unit: ValueUnit) -> Result<Self, InputError> {
        if columns == 0 || u32::try_from(columns).is_err() {
            return Err(size_error(0, columns));
        }
        Ok(Self { columns, unit, begins: vec![0], entries: Vec::new() })
    }

    /// A matrix of real numbers, in the largest unit of which all are multiples. Zeros of either sign are left out.
    ///
    /// # Errors
    /// [`InputError`] if there is no unit in which 32 bits hold all numbers.
    pub fn from_coordinates(matrix: &CoordinateMatrix) -> Result<Self, InputError> {
        if let Some(&(row, column, value)) = matrix.entries.iter().find(|(.., value)| !value.is_finite()) {
            return Err(input_error!("expected finite values, found {value} in row {row}, column {column}"));
        }
        Self::in_unit(matrix, ValueUnit::of_numbers(matrix.entries.iter().map(|&(.., value)| value))?)
    }

    /// A matrix of multiples of a unit that 32 bits hold.
    pub(super) fn in_unit(matrix: &CoordinateMatrix, unit: ValueUnit) -> Result<Self, InputError> {
        let mut sparse = Self::of_unit(matrix.columns, unit)?;
        let mut rows = matrix.entries.chunk_by(|a, b| a.0 == b.0).peekable();
        let mut row = Vec::new();
        for number in 0..matrix.rows {
            let entries = rows.next_if(|entries| entries[0].0 as usize == number).unwrap_or_default();
            let entry = |&(_, index, value): &(u32, u32, f64)| {
                let value = unit.entry(value).filter(|&value| value != 0);
                Some(MatrixEntry { index, value: value? })
            };
            row.clear();
            row.extend(entries.iter().filter_map(entry));
            sparse.push_row(&row)?;
        }
        Ok(sparse)
    }

    /// Appends a row.
    ///
    /// # Errors
    /// [`InputError`]; the matrix is then unchanged.
    pub fn push_row(&mut self, row: &[MatrixEntry]) -> Result<(), InputError> {
        let (number, columns) = (self.rows(), self.columns);
        if u32::try_from(number + 1).is_err() {
            return Err(size_error(number + 1, columns));
        }
        let mut before = None;
        for &MatrixEntry { index: column, value } in row {
            match before {
                _ if column as usize >= columns => {
                    return Err(input_error!("expected a column below {columns} in row {number}, found {column}"));
                }
                Some(before) if before >= column => {
                    return Err(input_error!(
                        "expected increasing columns in row {number}, found {column} after {before}: is an entry \
         given twice?"
                    ));
                }
                _ if value == 0 => {
                    return Err(input_error!("expected values other than 0, found 0 in row {number}, column {column}"));
                }
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

    /// The unit of values.
    pub fn unit(&self) -> ValueUnit {
        self.unit
    }

    /// The number that an entry holds, exactly.
    #[inline]
    pub fn value(&self, entry: i32) -> f64 {
        self.unit.value(entry)
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
            (vec![entry(4, 1)], input_error!("expected a column below 4 in row 1, found 4")),
            (
                vec![entry(2, 1), entry(2, 3)],
                input_error!("expected increasing columns in row 1, found 2 after 2: is an entry given twice?"),
            ),
            (vec![entry(1, 0)], input_error!("expected values other than 0, found 0 in row 1, column 1")),
        ];
        for (row, error) in wrong {
            assert_eq!(matrix.push_row(&row), Err(error));
            assert_eq!(matrix, before);
        }
        assert_eq!(SparseMatrix::new(0, 2), Err(size_error(0, 0)));
        assert_eq!((matrix.value(1), matrix.nonzeros()), (0.25, 2));
    }

    fn of(entries: &[(u32, u32, f64)]) -> Result<SparseMatrix, InputError> {
        SparseMatrix::from_coordinates(&CoordinateMatrix { rows: 3, columns: 4, entries: entries.to_vec() })
    }

    #[test]
    fn real_numbers_get_a_unit() {
        let matrix = of(&[(0, 1, 0.5), (0, 2, -0.0), (2, 0, -3.0), (2, 1, 0.0), (2, 3, 0.25)]).unwrap();
        assert_eq!((matrix.unit().fraction_bits(), matrix.nonzeros(), matrix.rows()), (2, 3, 3));
        assert_eq!(matrix.row(2), [MatrixEntry { index: 0, value: -12 }, MatrixEntry { index: 3, value: 1 }]);
        let infinite = input_error!("expected finite values, found {} in row 1, column 1", f64::INFINITY);
        assert_eq!(of(&[(0, 0, 0.1), (1, 1, f64::INFINITY)]), Err(infinite));
    }
}
