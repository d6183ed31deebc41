//! Tables of numbers, row by row: comma-separated values, and NumPy's arrays ([`super::npy`]).
//!
//! In comma-separated values each line is a row, all rows have the same number of columns, and a first line without any
//! number is a header. Numbers are read as f64 for computation, or as f32 ([`TableNumber`]) for signals, which `.npz`
//! files store as f32.

use std::path::Path;

use super::headed_table::{rows, syntax};
use super::lines::{double, single};
use super::{NumberError, quoted, to_f32};
use crate::error::{FilePlace, InputError, input_error};

/// Longest file that is read, in bytes (2 GiB).
pub const MAX_BYTES: u64 = 1 << 31;

/// Rows with the same number of columns, stored row by row. They may be infinite or NaN if the file format allows it.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberTable<T = f32> {
    /// Numbers per row.
    pub columns: usize,
    /// All numbers: a multiple of `columns`.
    pub values: Vec<T>,
}

/// A number of a table, in single or in double precision.
pub trait TableNumber: Copy {
    /// Parses a decimal number, rounded once to the nearest.
    fn parse(word: &[u8]) -> Result<Self, NumberError>;
    /// Converts from single precision, exactly.
    fn of_single(number: f32) -> Self;
    /// Converts from double precision, rounded to the nearest.
    fn of_double(number: f64) -> Result<Self, NumberError>;
}

impl TableNumber for f32 {
    fn parse(word: &[u8]) -> Result<Self, NumberError> {
        single(word)
    }

    fn of_single(number: f32) -> Self {
        number
    }

    fn of_double(number: f64) -> Result<Self, NumberError> {
        to_f32(number)
    }
}

impl TableNumber for f64 {
    fn parse(word: &[u8]) -> Result<Self, NumberError> {
        double(word)
    }

    fn of_single(number: f32) -> Self {
        number.into()
    }

    fn of_double(number: f64) -> Result<Self, NumberError> {
        Ok(number)
    }
}

/// Reads a comma-separated table from bytes; `name` is the file's name in messages.
pub fn parse_number_table<T: TableNumber>(bytes: &[u8], name: &Path) -> Result<NumberTable<T>, InputError> {
    let mut reader = rows(bytes);
    let (mut columns, mut values, mut record) = (0, Vec::new(), csv::ByteRecord::new());
    let mut is_first = true;
    while reader.read_byte_record(&mut record).map_err(|reason| syntax(reason, name))? {
        let header = record.iter().all(|field| matches!(T::parse(field), Err(NumberError::NoNumber)));
        if std::mem::take(&mut is_first) && header {
            continue;
        }
        let line = record.position().map_or(0, |position| position.line() as usize);
        if columns != 0 && record.len() != columns {
            return Err(input_error!("crossbar::table::ragged" =>
                "expected {columns} numbers as in the first row, found {} {}", record.len(),
                if record.len() == 1 { "field" } else { "fields" }; help "give every row the same number of fields")
            .at(FilePlace::line(name, line)));
        }
        columns = record.len();
        for (field, text) in (1..).zip(&record) {
            values.push(T::parse(text).map_err(|reason| {
                input_error!("crossbar::table::number" =>
                    "expected {} in field {field}, found {}", reason.expected(), quoted(text))
                .at(FilePlace::line(name, line))
            })?);
        }
    }
    if values.is_empty() {
        return Err(
            input_error!("crossbar::table::empty" => "expected at least one row of numbers, found none").at(name)
        );
    }
    Ok(NumberTable { columns, values })
}
