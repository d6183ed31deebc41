//! Numbers from NumPy arrays or comma-separated values, recognised by the first bytes of a file.

use std::path::Path;

use super::error::read_file;
use super::npy::{self, NumberArray, parse_npy, parse_npy_array};
use super::number_table::{NumberTable, TableNumber, parse_number_table};
use crate::error::InputError;

/// The numbers of a NumPy array or of comma-separated values; `name` is the file's name in messages.
pub fn parse_numbers<T: TableNumber>(bytes: &[u8], name: &Path) -> Result<NumberTable<T>, InputError> {
    if bytes.starts_with(npy::MAGIC) { parse_npy(bytes, name) } else { parse_number_table(bytes, name) }
}

/// [`parse_numbers`] from a file of at most `limit` bytes, which is a `what`.
pub fn load_numbers<T: TableNumber>(path: &Path, what: &'static str, limit: u64) -> Result<NumberTable<T>, InputError> {
    parse_numbers(&read_file(path, what, limit)?, path)
}

/// The numbers of an array of NumPy's with its shape, from a file of at most `limit` bytes, which is a `what`.
pub fn load_npy_array(path: &Path, what: &'static str, limit: u64) -> Result<NumberArray, InputError> {
    parse_npy_array(&read_file(path, what, limit)?, path)
}
