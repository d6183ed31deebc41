//! Sparse matrices: the transfer matrix T, or any matrix of finite numbers.
//!
//! Averaging 2^m x 2^m visibility samples gives multiples of 2^-2m (section IV-A), which entries store as integers;
//! other numbers are in a table ([`EntryValues`]). Multiples of a unit are subtracted without rounding, so "lossless"
//! results are equal.

use crate::error::{InputError, ensure, input_error};
use crate::io::CoordinateMatrix;

const TWO_TO_63: f64 = 9_223_372_036_854_775_808.0;

/// An entry of a row or column: its index along the line, and an integer that encodes its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MatrixEntry {
    /// The column of an entry of a row; the row of an entry of a column.
    pub index: u32,
    /// The value, encoded by the [`EntryValues`] of the matrix or of the biclusters: equal integers represent equal
    /// numbers, 0 represents 0, and integers have the order of the numbers.
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
    /// Creates a matrix of 0 rows and `columns` columns, with values in units of 2^-`fraction_bits`. Fails with
    /// [`InputError`] for 0 columns, or more than 32 bits can count. Panics if `fraction_bits` exceeds
    /// [`EntryValues::MOST_FRACTION_BITS`].
    pub fn new(columns: usize, fraction_bits: u32) -> Result<Self, InputError> {
        Self::of_values(columns, EntryValues::units(fraction_bits))
    }

    /// Like [`Self::new`], for any values.
    pub(super) fn of_values(columns: usize, values: EntryValues) -> Result<Self, InputError> {
        if columns == 0 || u32::try_from(columns).is_err() {
            return Err(size_error(0, columns));
        }
        Ok(Self { columns, values, begins: vec![0], entries: Vec::new() })
    }

    /// Converts real numbers to their largest common power-of-two unit, if it has at most
    /// [`EntryValues::MOST_FRACTION_BITS`] and 32 bits hold the multiples, else to a table. Zeros of either sign are
    /// dropped.
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

    /// Converts multiples of 2^-`fraction_bits` within 32 bits to a matrix in this unit.
    pub(super) fn in_units(matrix: &CoordinateMatrix, fraction_bits: u32) -> Result<Self, InputError> {
        Self::of_entries(matrix, EntryValues::units(fraction_bits))
    }

    /// Encodes entries by these values; zeros are dropped.
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

    /// Appends a row. Fails with [`InputError`]; the matrix is then unchanged.
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

    /// Number of rows: in a transfer matrix M n, M local directions for each of n vertices.
    pub fn rows(&self) -> usize {
        self.begins.len() - 1
    }

    /// Number of columns: in a transfer matrix N, the number of light texels.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The numbers that entries represent.
    pub fn values(&self) -> &EntryValues {
        &self.values
    }

    /// The number that an entry represents, exactly. Panics if no such entry is possible.
    #[inline]
    pub fn value(&self, entry: i32) -> f64 {
        self.values.value(entry)
    }

    /// Number of entries: nnz(T).
    pub fn nonzeros(&self) -> usize {
        self.entries.len()
    }

    /// The entries of a row, in order of columns. Panics if there is no such row.
    pub fn row(&self, row: usize) -> &[MatrixEntry] {
        &self.entries[self.begins[row]..self.begins[row + 1]]
    }

    pub(super) fn to_rows(&self) -> Vec<Vec<MatrixEntry>> {
        (0..self.rows()).map(|row| self.row(row).to_vec()).collect()
    }
}

/// The smallest number of fraction bits f such that every value is a multiple of 2^-f that fits into 32 bits; `None` if
/// there is none.
fn unit_of(values: impl Iterator<Item = f64> + Clone) -> Option<u32> {
    let finest = f64::from(1_u32 << EntryValues::MOST_FRACTION_BITS);
    let mut fraction_bits = 0;
    for value in values.clone() {
        // Exact: the factor is a power of two. Values that it makes infinite are out of range for every unit.
        let scaled = value * finest;
        if scaled.fract() != 0.0 {
            return None;
        }
        // Numbers beyond 64 bits are rejected below, in any unit.
        let zeros = if scaled.abs() < TWO_TO_63 { (scaled as i64).trailing_zeros() } else { 64 };
        fraction_bits = fraction_bits.max(EntryValues::MOST_FRACTION_BITS.saturating_sub(zeros));
    }
    let unit = f64::from(1_u32 << fraction_bits);
    values.map(|value| value * unit).all(|units| units.abs() <= f64::from(i32::MAX)).then_some(fraction_bits)
}

/// The numbers that entries represent.
#[derive(Clone, Debug, PartialEq)]
pub struct EntryValues {
    /// Number of fraction bits of a unit whose 32-bit multiples are all values of the matrix; `None` if there is no
    /// such unit.
    fraction_bits: Option<u32>,
    /// Unit of the values; 1 if they have none.
    unit: f64,
    /// If entries are not in units: the numbers in increasing order; entry 1 represents the first.
    table: Option<Vec<f64>>,
}

impl EntryValues {
    /// The largest number of fraction bits of a unit: more than the difference of two f32 numbers in [0, 1] needs.
    pub const MOST_FRACTION_BITS: u32 = 30;

    /// Multiples of 2^-`fraction_bits`. Panics if `fraction_bits` exceeds [`Self::MOST_FRACTION_BITS`].
    pub fn units(fraction_bits: u32) -> Self {
        assert!(fraction_bits <= Self::MOST_FRACTION_BITS, "a unit of 2^-30 or more, not 2^-{fraction_bits}");
        Self { fraction_bits: Some(fraction_bits), unit: 1.0 / f64::from(1_u32 << fraction_bits), table: None }
    }

    /// Creates a table of finite numbers, which may be unordered and repeated; zeros are dropped. If only biclusters
    /// overflow 32 bits, the values of the matrix still have a common unit.
    pub(super) fn table(fraction_bits: Option<u32>, numbers: impl Iterator<Item = f64>) -> Self {
        let mut numbers: Vec<f64> = numbers.filter(|&value| value != 0.0).collect();
        numbers.sort_unstable_by(f64::total_cmp);
        numbers.dedup();
        let unit = fraction_bits.map_or(1.0, |bits| Self::units(bits).unit);
        Self { fraction_bits, unit, table: Some(numbers) }
    }

    /// Encodes numbers in the unit of the matrix, if there is one and 32 bits hold all numbers, else in a table.
    pub(super) fn of_numbers(fraction_bits: Option<u32>, numbers: impl Iterator<Item = f64> + Clone) -> Self {
        let units = fraction_bits.map(Self::units);
        let units = units.filter(|units| numbers.clone().all(|number| units.entry(number).is_some()));
        units.unwrap_or_else(|| Self::table(fraction_bits, numbers))
    }

    /// Number of fraction bits of the common unit of all values, if there is one.
    pub fn fraction_bits(&self) -> Option<u32> {
        self.fraction_bits
    }

    /// The number of values in the table; `None` if entries are in units.
    pub fn table_len(&self) -> Option<usize> {
        self.table.as_ref().map(Vec::len)
    }

    /// The number that an entry represents. Panics if the table has no such entry.
    #[inline]
    pub fn value(&self, entry: i32) -> f64 {
        match &self.table {
            None => self.unit * f64::from(entry),
            Some(table) => table[(entry - 1) as usize],
        }
    }

    /// The entry that represents a number; `None` if the number is neither in the table nor a multiple of the unit
    /// within 32 bits.
    pub(super) fn entry(&self, value: f64) -> Option<i32> {
        match &self.table {
            None => {
                // Exact: the unit is a power of two.
                let units = value / self.unit;
                (units == f64::from(units as i32)).then_some(units as i32)
            }
            Some(table) => {
                let found = table.binary_search_by(|other| other.total_cmp(&value));
                found.ok().and_then(|index| i32::try_from(index + 1).ok())
            }
        }
    }

    /// True if an entry has this integer.
    pub(super) fn has(&self, entry: i32) -> bool {
        entry != 0 && self.table.as_ref().is_none_or(|table| (1..=table.len()).contains(&(entry as usize)))
    }
}

impl std::fmt::Display for EntryValues {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.table_len(), self.fraction_bits) {
            (None, Some(0)) => f.write_str("whole numbers"),
            (None, bits) => write!(f, "whole numbers of 2^-{}", bits.unwrap_or(0)),
            (Some(1), _) => f.write_str("1 number in a table"),
            (Some(count), _) => write!(f, "{count} numbers in a table"),
        }
    }
}
