//! Sparse matrices: the transfer matrix T, or any matrix of finite numbers.
//!
//! Averaging 2^m x 2^m visibility samples gives multiples of 2^-2m (section IV-A), which entries hold as integers;
//! other numbers are in a table ([`EntryValues`]). Multiples of a unit are subtracted without rounding, so that
//! "lossless" means equal.

use super::values::EntryValues;
use crate::error::{InputError, ensure, input_error};
use crate::io::CoordinateMatrix;

const TWO_TO_63: f64 = 9_223_372_036_854_775_808.0;

/// An entry of a row or column: its index along the line, and an integer for its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MatrixEntry {
    /// The column of an entry of a row; the row of an entry of a column.
    pub index: u32,
    /// The value, as [`EntryValues`] of the matrix or of the biclusters has it: equal integers are equal numbers, 0 is
    /// 0, and signs and order are those of the numbers.
    pub value: i32,
}

/// A sparse matrix, row by row. Columns increase along a row; no value is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseMatrix {
    columns: usize,
    values: EntryValues,
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
    /// If `fraction_bits` exceeds [`EntryValues::MOST_FRACTION_BITS`].
    pub fn new(columns: usize, fraction_bits: u32) -> Result<Self, InputError> {
        Self::of_values(columns, EntryValues::units(fraction_bits))
    }

    /// The same for any values.
    pub(super) fn of_values(columns: usize, values: EntryValues) -> Result<Self, InputError> {
        if columns == 0 || u32::try_from(columns).is_err() {
            return Err(size_error(0, columns));
        }
        Ok(Self { columns, values, begins: vec![0], entries: Vec::new() })
    }

    /// A matrix of real numbers: in the largest power-of-two unit of which all are multiples, if this has at most
    /// [`EntryValues::MOST_FRACTION_BITS`] and 32 bits hold the multiples; else with a table. Zeros of either sign are
    /// left out.
    ///
    /// # Errors
    /// [`InputError`].
    pub fn from_coordinates(matrix: &CoordinateMatrix) -> Result<Self, InputError> {
        if let Some(&(row, column, value)) = matrix.entries.iter().find(|(.., value)| !value.is_finite()) {
            return Err(input_error!("expected finite values, found {value} in row {row}, column {column}"));
        }
        let values = || matrix.entries.iter().map(|&(.., value)| value).filter(|&value| value != 0.0);
        let in_units = unit_of(values());
        let values = match in_units {
            Some(fraction_bits) => EntryValues::units(fraction_bits),
            None => {
                let table = EntryValues::table(None, values());
                let found = table.table_len().unwrap_or(0);
                ensure!(i32::try_from(found).is_ok(), "expected at most {} distinct values, found {found}", i32::MAX);
                table
            }
        };
        Self::of_entries(matrix, values)
    }

    /// A matrix in units of 2^-`fraction_bits`, of multiples of these that 32 bits hold.
    pub(super) fn in_units(matrix: &CoordinateMatrix, fraction_bits: u32) -> Result<Self, InputError> {
        Self::of_entries(matrix, EntryValues::units(fraction_bits))
    }

    /// Entries that have these values, or are 0.
    fn of_entries(matrix: &CoordinateMatrix, values: EntryValues) -> Result<Self, InputError> {
        let mut sparse = Self::of_values(matrix.columns, values)?;
        let mut rows = matrix.entries.chunk_by(|a, b| a.0 == b.0).peekable();
        let mut row = Vec::new();
        for number in 0..matrix.rows {
            let entries = rows.next_if(|entries| entries[0].0 as usize == number).unwrap_or_default();
            let entry = |&(_, index, value): &(u32, u32, f64)| {
                let value = if value == 0.0 { None } else { sparse.values.entry(value) };
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
                _ if !self.values.has(value) => {
                    let most = self.values.table_len().unwrap_or(0);
                    return Err(input_error!(
                        "expected a value of the table of {most} values in row {number}, column {column}, found entry \
         {value}"
                    ));
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

    /// The numbers that entries stand for.
    pub fn values(&self) -> &EntryValues {
        &self.values
    }

    /// The number that an entry holds, exactly.
    ///
    /// # Panics
    /// If the matrix can have no such entry.
    #[inline]
    pub fn value(&self, entry: i32) -> f64 {
        self.values.value(entry)
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

/// The least number of fraction bits of a unit of which all values are multiples that 32 bits hold, if there is one.
fn unit_of(values: impl Iterator<Item = f64> + Clone) -> Option<u32> {
    let finest = f64::from(1_u32 << EntryValues::MOST_FRACTION_BITS);
    let mut fraction_bits = 0;
    for value in values.clone() {
        // Exact: the factor is a power of two. What it takes to infinity is out of range in any unit.
        let scaled = value * finest;
        if scaled.fract() != 0.0 {
            return None;
        }
        // Numbers beyond 64 bits are refused below, in any unit.
        let zeros = if scaled.abs() < TWO_TO_63 { (scaled as i64).trailing_zeros() } else { 64 };
        fraction_bits = fraction_bits.max(EntryValues::MOST_FRACTION_BITS.saturating_sub(zeros));
    }
    let unit = f64::from(1_u32 << fraction_bits);
    values.map(|value| value * unit).all(|units| units.abs() <= f64::from(i32::MAX)).then_some(fraction_bits)
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
    fn real_numbers_get_the_largest_units() {
        let matrix = of(&[(0, 1, 0.5), (2, 0, -3.0), (2, 1, 0.0), (2, 3, 0.25)]).unwrap();
        assert_eq!((matrix.values().fraction_bits(), matrix.nonzeros(), matrix.rows()), (Some(2), 3, 3));
        assert_eq!(matrix.row(2), [MatrixEntry { index: 0, value: -12 }, MatrixEntry { index: 3, value: 1 }]);
        assert_eq!(of(&[(0, 1, 6e8)]).unwrap().values().fraction_bits(), Some(0));
        assert_eq!(of(&[]).unwrap().values().fraction_bits(), Some(0));
    }

    #[test]
    fn numbers_without_a_unit_get_a_table() {
        for numbers in [[0.1, 0.25], [6e8, 0.25], [1e200, 1.0], [f64::from_bits(1), -1e300], [f64::MAX, -0.1]] {
            let [a, b] = numbers;
            let matrix = of(&[(0, 1, a), (0, 2, -0.0), (2, 0, b), (2, 1, a)]).unwrap();
            let values = matrix.values();
            assert_eq!((values.fraction_bits(), values.table_len(), matrix.nonzeros()), (None, Some(2), 3));
            let of_row = |row: usize| matrix.row(row).iter().map(|entry| matrix.value(entry.value)).collect::<Vec<_>>();
            assert_eq!((of_row(0), of_row(1), of_row(2)), (vec![a], vec![], vec![b, a]));
            let mut more = matrix.clone();
            let foreign = MatrixEntry { index: 3, value: 3 };
            let error = input_error!("expected a value of the table of 2 values in row 3, column 3, found entry 3");
            assert_eq!((more.push_row(&[foreign]), &more), (Err(error), &matrix));
        }
        let infinite = input_error!("expected finite values, found {} in row 1, column 1", f64::INFINITY);
        assert_eq!(of(&[(0, 0, 0.1), (1, 1, f64::INFINITY)]), Err(infinite));
    }
}
