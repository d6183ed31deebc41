//! Numbers from NumPy arrays or comma-separated values, recognised by the first bytes of a file.

use std::path::Path;

use super::error::read_file;
use super::npy::{self, NumberArray, parse_npy, parse_npy_array};
use super::number_table::{NumberTable, TableNumber, parse_number_table};
use crate::error::InputError;

/// The numbers of a NumPy array or of comma-separated values; `name` is the file's name in messages.
///
/// # Errors
/// [`InputError`].
pub fn parse_numbers<T: TableNumber>(bytes: &[u8], name: &Path) -> Result<NumberTable<T>, InputError> {
    if bytes.starts_with(npy::MAGIC) { parse_npy(bytes, name) } else { parse_number_table(bytes, name) }
}

/// [`parse_numbers`] from a file of at most `limit` bytes, which is a `what`.
///
/// # Errors
/// [`InputError`].
pub fn load_numbers<T: TableNumber>(path: &Path, what: &'static str, limit: u64) -> Result<NumberTable<T>, InputError> {
    parse_numbers(&read_file(path, what, limit)?, path)
}

/// The numbers of an array of NumPy's with its shape, from a file of at most `limit` bytes, which is a `what`.
///
/// # Errors
/// [`InputError`].
pub fn load_npy_array(path: &Path, what: &'static str, limit: u64) -> Result<NumberArray, InputError> {
    parse_npy_array(&read_file(path, what, limit)?, path)
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
            assert_eq!(parse_numbers(bytes, name).expect("numbers"), table);
            let wide = NumberTable { columns: 2, values: values.map(f64::from).to_vec() };
            assert_eq!(parse_numbers(bytes, name).expect("numbers"), wide);
        }
        let error = parse_numbers::<f64>(b"1,2\n3\n", name).expect_err("ragged");
        assert_eq!(error.error_code(), "crossbar::table::ragged");
        let cut = parse_numbers::<f64>(&array[..array.len() - 1], name).expect_err("cut");
        assert_eq!(cut.error_code(), "crossbar::npy::size");
        let missing = load_numbers::<f64>(Path::new("no/such/file.csv"), "table", 8).expect_err("missing");
        assert_eq!(missing.error_code(), "crossbar::file::unreadable");
    }
}
