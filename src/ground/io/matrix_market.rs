//! Sparse matrices as Matrix Market files: `%%MatrixMarket matrix coordinate real general`, comments, a line with the
//! numbers of rows, columns and entries, then a line `row column value` per entry, in any order, counted from 1.
//!
//! The reader also accepts the field `integer`. Numbers are rounded to the nearest f64. The reader rejects numbers that
//! round to 0 or infinity, other fields, dense arrays and symmetries.

use std::io::{self, Write};
use std::path::Path;

use super::error::read_file;
use super::lines::{double, lines, unmarked, words};
use super::quoted;
use crate::error::{FilePlace, InputError, input_error};

/// Longest file that is read, in bytes (4 GiB).
pub const MAX_BYTES: u64 = 1 << 32;
/// Number of rows and of columns that every file may have (2^24). A file with more bytes may have as many rows or
/// columns as bytes, so the size of a file bounds the size of its matrix.
pub const ANY_SIZE: usize = 1 << 24;
/// Length of the shortest line of an entry: `1 1 1` and a line feed.
const SHORTEST: usize = 6;

/// A sparse matrix by its entries.
#[derive(Clone, Debug, PartialEq)]
pub struct CoordinateMatrix {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Row and column from 0, and value; row by row, columns increasing, without repetition. Values are finite, and may
    /// be 0.
    pub entries: Vec<(u32, u32, f64)>,
}

/// Reads a matrix from a file.
pub fn load_matrix_market(path: &Path) -> Result<CoordinateMatrix, InputError> {
    parse_matrix_market(&read_file(path, "matrix", MAX_BYTES)?, path)
}

/// Reads a matrix from bytes; `name` is the file's name in messages.
pub fn parse_matrix_market(bytes: &[u8], name: &Path) -> Result<CoordinateMatrix, InputError> {
    let mut lines = lines(unmarked(bytes));
    let banner = lines.next().map_or(&[][..], |(_, banner)| banner);
    let fields = String::from_utf8_lossy(banner).to_lowercase();
    let fields: Vec<&str> = fields.split_ascii_whitespace().collect();
    if !matches!(fields[..], ["%%matrixmarket", "matrix", "coordinate", "real" | "double" | "integer", "general"]) {
        return Err(input_error!("crossbar::matrix_market::banner" =>
            "expected `%%MatrixMarket matrix coordinate` with `real` or `integer`, then `general`; found {}",
            quoted(banner.trim_ascii()); help "write all entries of the matrix, as real numbers")
        .at(FilePlace::line(name, 1)));
    }
    // Comments may follow the banner, and empty lines may be anywhere.
    let mut lines = lines.filter(|(_, text)| !text.trim_ascii().is_empty());
    let (size_line, size) = lines.by_ref().find(|(_, text)| !text.starts_with(b"%")).unwrap_or((2, &b""[..]));
    let [rows, columns, count] = sizes(size).ok_or_else(|| {
        input_error!("crossbar::matrix_market::size" =>
            "expected the numbers of rows, columns and entries, found {}", quoted(size.trim_ascii()))
        .at(FilePlace::line(name, size_line))
    })?;
    let most = bytes.len().max(ANY_SIZE);
    if rows.max(columns) > most {
        let bytes = bytes.len();
        return Err(input_error!("crossbar::matrix_market::claim" =>
            "expected at most {most} rows and columns in a file of {bytes} bytes, found {rows} x {columns}";
            help "remove empty rows and columns: beyond {ANY_SIZE}, a file may have at most one per byte")
        .at(FilePlace::line(name, size_line)));
    }
    // Memory is allocated only in proportion to the file's bytes.
    let mut entries = Vec::with_capacity(count.min(bytes.len() / SHORTEST));
    for (line, text) in lines {
        entries.push(entry(text, [rows, columns]).map_err(|error| error.at(FilePlace::line(name, line)))?);
    }
    if entries.len() != count {
        return Err(input_error!("crossbar::matrix_market::count" =>
            "expected {count} entries as line {size_line} says, found {}", entries.len(); help "is the file truncated?")
        .at(name));
    }
    entries.sort_unstable_by_key(|&(row, column, _)| (row, column));
    if let Some(pair) = entries.windows(2).find(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
        return Err(input_error!("crossbar::matrix_market::twice" =>
            "expected one entry for row {}, column {}, found two", pair[0].0 + 1, pair[0].1 + 1;
            help "add the two entries, or remove one of them")
        .at(name));
    }
    Ok(CoordinateMatrix { rows, columns, entries })
}

/// The text of a matrix given as entries `(row, column, value)`, counted from 0, row by row. Values have the shortest
/// digits that read back to the same numbers.
pub fn write_matrix_market(
    [rows, columns, count]: [usize; 3],
    comment: &str,
    entries: impl Iterator<Item = (usize, usize, f64)>,
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out, "%%MatrixMarket matrix coordinate real general")?;
    comment.lines().try_for_each(|line| writeln!(out, "% {line}"))?;
    writeln!(out, "{rows} {columns} {count}")?;
    for (row, column, value) in entries {
        // Without an exponent, a number far from 1 would have hundreds of zeros.
        if value == 0.0 || (1e-5..1e16).contains(&value.abs()) {
            writeln!(out, "{} {} {value}", row + 1, column + 1)?;
        } else {
            writeln!(out, "{} {} {value:e}", row + 1, column + 1)?;
        }
    }
    Ok(())
}

fn sizes(line: &[u8]) -> Option<[usize; 3]> {
    let [rows, columns, count] = words(line)[..] else { return None };
    let [rows, columns, count] = [whole(rows)?, whole(columns)?, whole(count)?];
    let nameable = |size: usize| (1..=u32::MAX as usize).contains(&size);
    (nameable(rows) && nameable(columns)).then_some([rows, columns, count])
}

fn whole(word: &[u8]) -> Option<usize> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

fn entry(text: &[u8], [rows, columns]: [usize; 2]) -> Result<(u32, u32, f64), InputError> {
    let wrong = |expected: &str, found: &[u8]| {
        input_error!("crossbar::matrix_market::entry" =>
            "expected {expected}, found {}", quoted(found);
            help "a line `row column value` per entry, rows and columns counted from 1")
    };
    let place = |what: &str, found: &[u8], most: usize| {
        let place = whole(found).filter(|place| (1..=most).contains(place));
        place.map(|place| (place - 1) as u32).ok_or_else(|| wrong(&format!("a {what} from 1 to {most}"), found))
    };
    let [row, column, value] = words(text)[..] else {
        return Err(wrong("a row, a column and a value", text.trim_ascii()));
    };
    let (row, column) = (place("row", row, rows)?, place("column", column, columns)?);
    let number = double(value).map_err(|fault| wrong(fault.expected(), value))?;
    let mut digits = value.split(|byte| byte.eq_ignore_ascii_case(&b'e')).next().unwrap_or_default().iter();
    if number == 0.0 && digits.any(|digit| (b'1'..=b'9').contains(digit)) {
        return Err(wrong("a number that a 64-bit float does not round to 0", value));
    }
    Ok((row, column, number))
}
