//! Sparse matrices: the transfer matrix T, or any matrix of finite numbers.
//!
//! Averaging 2^m x 2^m visibility samples gives multiples of 2^-2m (section IV-A), which entries store as integers.
//! Integers are subtracted without rounding, so "lossless" results are equal.

use crate::error::{InputError, input_error};
use crate::io::CoordinateMatrix;
use refsim::num::power_of_two;

/// The largest number of fraction bits of a unit: more than the difference of two f32 numbers in [0, 1] needs.
pub const MOST_FRACTION_BITS: u32 = 30;

const TWO_TO_63: f64 = 9_223_372_036_854_775_808.0;

/// An entry of a row or column: its index along the line, and its value in units of the matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MatrixEntry {
    /// The column of an entry of a row; the row of an entry of a column.
    pub index: u32,
    /// The value, as a multiple of 2^-`fraction_bits` of the matrix or of the biclusters.
    pub value: i32,
}

/// The number that an integer represents in units of 2^-`fraction_bits`.
#[inline]
pub(super) fn number(value: i32, fraction_bits: u32) -> f64 {
    power_of_two(-fraction_bits.cast_signed()) * f64::from(value)
}

/// A sparse matrix, row by row. Columns increase along a row; no value is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseMatrix {
    columns: usize,
    fraction_bits: u32,
    begins: Vec<usize>,
    entries: Vec<MatrixEntry>,
}

pub(super) fn size_error(rows: usize, columns: usize) -> InputError {
    input_error!("expected 1 to {} rows and columns, found {rows} x {columns}", u32::MAX)
}

impl SparseMatrix {
    /// Creates a matrix of 0 rows and `columns` columns, with values in units of 2^-`fraction_bits`. Fails with
    /// [`InputError`] for 0 columns, or more columns than 32 bits can count. Panics if `fraction_bits` exceeds
    /// [`MOST_FRACTION_BITS`].
    pub fn new(columns: usize, fraction_bits: u32) -> Result<Self, InputError> {
        assert!(fraction_bits <= MOST_FRACTION_BITS, "a unit of 2^-30 or more, not 2^-{fraction_bits}");
        if columns == 0 || u32::try_from(columns).is_err() {
            return Err(size_error(0, columns));
        }
        Ok(Self { columns, fraction_bits, begins: vec![0], entries: Vec::new() })
    }

    /// Converts numbers to multiples of their largest common power-of-two unit. Zeros of either sign are dropped. Fails
    /// with [`InputError`] unless all numbers are 32-bit multiples of a unit with at most [`MOST_FRACTION_BITS`].
    pub fn from_coordinates(matrix: &CoordinateMatrix) -> Result<Self, InputError> {
        if let Some(&(row, column, value)) = matrix.entries.iter().find(|(.., value)| !value.is_finite()) {
            return Err(input_error!("expected finite values, found {value} in row {row}, column {column}"));
        }
        let Some(fraction_bits) = unit_of(matrix.entries.iter().map(|&(.., value)| value)) else {
            return Err(input_error!(
                "expected multiples of a single power of two (2^-{MOST_FRACTION_BITS} or larger) by 32-bit factors, \
                 found other numbers"
            ));
        };
        let mut sparse = Self::new(matrix.columns, fraction_bits)?;
        let unit = power_of_two(fraction_bits.cast_signed());
        let mut rows = matrix.entries.chunk_by(|a, b| a.0 == b.0).peekable();
        for number in 0..matrix.rows {
            let entries = rows.next_if(|entries| entries[0].0 as usize == number).unwrap_or_default();
            let entries = entries.iter().filter(|(.., value)| *value != 0.0);
            // Exact: the unit is a power of two.
            let row: Vec<MatrixEntry> =
                entries.map(|&(_, index, value)| MatrixEntry { index, value: (value * unit) as i32 }).collect();
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

    /// Number f of fraction bits: values are multiples of 2^-f.
    pub fn fraction_bits(&self) -> u32 {
        self.fraction_bits
    }

    /// The number that an entry's value represents, exactly.
    #[inline]
    pub fn value(&self, value: i32) -> f64 {
        number(value, self.fraction_bits)
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
    let finest = f64::from(1_u32 << MOST_FRACTION_BITS);
    let mut fraction_bits = 0;
    for value in values.clone() {
        // Exact: the factor is a power of two. Values that it makes infinite are out of range for every unit.
        let scaled = value * finest;
        if scaled.fract() != 0.0 {
            return None;
        }
        // Numbers beyond 64 bits are rejected below, in any unit.
        let zeros = if scaled.abs() < TWO_TO_63 { (scaled as i64).trailing_zeros() } else { 64 };
        fraction_bits = fraction_bits.max(MOST_FRACTION_BITS.saturating_sub(zeros));
    }
    let unit = f64::from(1_u32 << fraction_bits);
    values.map(|value| value * unit).all(|units| units.abs() <= f64::from(i32::MAX)).then_some(fraction_bits)
}
