//! Numbers from NumPy arrays or comma-separated values, recognised by the first bytes of a file.

use std::path::Path;

use thiserror::Error;

use super::error::{ReadError, read};
use super::npy::{self, NpyError, NumberArray, parse_npy, parse_npy_array, parse_single_npy};
use super::number_table::{NumberTable, NumberTableError, parse_number_table, parse_single_table};

/// Errors of reading numbers.
#[non_exhaustive]
#[derive(Debug, Error, miette::Diagnostic)]
pub enum NumbersError {
    /// The file is not there, or too long.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Read(#[from] ReadError),
    /// It is an array of NumPy's that cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Npy(#[from] NpyError),
    /// It is a table that cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Table(#[from] NumberTableError),
}

/// The numbers of a NumPy array or of comma-separated values, rounded to the nearest f64; `name` is the file's name in
/// messages.
///
/// # Errors
/// [`NumbersError::Npy`] and [`NumbersError::Table`].
pub fn parse_numbers(bytes: &[u8], name: &Path) -> Result<NumberTable<f64>, NumbersError> {
    if bytes.starts_with(npy::MAGIC) {
        return Ok(parse_npy(bytes, name)?);
    }
    Ok(parse_number_table(bytes, name)?)
}

/// As [`parse_numbers`], rounded to the nearest f32.
///
/// # Errors
/// [`NumbersError::Npy`] and [`NumbersError::Table`].
pub fn parse_single_numbers(bytes: &[u8], name: &Path) -> Result<NumberTable, NumbersError> {
    if bytes.starts_with(npy::MAGIC) {
        return Ok(parse_single_npy(bytes, name)?);
    }
    Ok(parse_single_table(bytes, name)?)
}

/// [`parse_numbers`] from a file of at most `limit` bytes, which is a `what`.
///
/// # Errors
/// [`NumbersError`].
pub fn load_numbers(path: &Path, what: &'static str, limit: u64) -> Result<NumberTable<f64>, NumbersError> {
    parse_numbers(&read(path, what, limit)?, path)
}

/// The numbers of an array of NumPy's with its shape, from a file of at most `limit` bytes, which is a `what`.
///
/// # Errors
/// [`NumbersError::Read`] and [`NumbersError::Npy`].
pub fn load_npy_array(path: &Path, what: &'static str, limit: u64) -> Result<NumberArray, NumbersError> {
    Ok(parse_npy_array(&read(path, what, limit)?, path)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::write_npy;

    #[test]
    fn both_kinds_hold_the_same_numbers() {
        let name = Path::new("numbers");
        let values = [1.0_f32, 2.5, -3.0, 4.0];
        let (table, mut array) = (NumberTable { columns: 2, values: values.to_vec() }, Vec::new());
        write_npy(&table, &mut array).expect("written");
        for bytes in [&array[..], b"1,2.5\n-3,4\n"] {
            assert_eq!(parse_single_numbers(bytes, name).expect("numbers"), table);
            let wide = NumberTable { columns: 2, values: values.map(f64::from).to_vec() };
            assert_eq!(parse_numbers(bytes, name).expect("numbers"), wide);
        }
        let error = parse_numbers(b"1,2\n3\n", name).expect_err("ragged");
        assert!(matches!(error, NumbersError::Table(_)), "{error}");
        let cut = parse_numbers(&array[..array.len() - 1], name).expect_err("cut");
        assert!(matches!(cut, NumbersError::Npy(_)), "{cut}");
        let missing = load_numbers(Path::new("no/such/file.csv"), "table", 8).expect_err("missing");
        assert!(matches!(missing, NumbersError::Read(_)), "{missing}");
    }
}
