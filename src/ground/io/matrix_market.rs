//! Sparse matrices as Matrix Market files: `%%MatrixMarket matrix coordinate real general`, comments, a line with the
//! numbers of rows, columns and entries, then a line `row column value` per entry, in any order, counted from 1.
//!
//! The reader also accepts the fields `integer` and `pattern` (all entries are 1), and the symmetries `symmetric` and
//! `skew-symmetric`. Real numbers are rounded to the nearest f64. It rejects dense arrays, complex and Hermitian
//! matrices, integers that f64 cannot represent exactly, and real numbers that round to 0 or infinity.

use std::io::{self, Write};
use std::path::Path;

use super::error::read_file;
use super::lines::{double, lines, unmarked, words};
use super::quoted;
use crate::error::{FilePlace, InputError, input_error};

/// Longest file that is read, in bytes (4 GiB).
pub const MAX_BYTES: u64 = 1 << 32;
/// Number of rows and of columns that every file may have (2^24). A file of more bytes may have as many rows or columns
/// as bytes, so the size of a file bounds the size of its matrix.
pub const ANY_SIZE: usize = 1 << 24;
/// Length of the shortest line of an entry: `1 1` and a line feed.
const SHORTEST: usize = 4;

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
    let banner = Banner::parse(banner).ok_or_else(|| {
        input_error!("crossbar::matrix_market::banner" =>
            "{}:1: expected `%%MatrixMarket matrix coordinate` with `real`, `integer` or `pattern`, then `general`, \
             `symmetric` or `skew-symmetric`, which no `pattern` is; found {}", name.display(),
            quoted(banner.trim_ascii()); help "write the matrix by its entries, in real numbers")
    })?;
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
            help "leave out empty rows and columns: beyond {ANY_SIZE} there may be one per byte of the file")
        .at(FilePlace::line(name, size_line)));
    }
    if banner.symmetry != Symmetry::General && rows != columns {
        let symmetry = if banner.symmetry == Symmetry::Skew { "skew-symmetric" } else { "symmetric" };
        return Err(input_error!("crossbar::matrix_market::square" =>
            "expected as many rows as columns of a {symmetry} matrix, found {rows} x {columns}";
            help "write the matrix as `general`")
        .at(FilePlace::line(name, size_line)));
    }
    let reader = EntryReader { name, banner, size: [rows, columns] };
    // Memory is allocated in proportion to the file's bytes only.
    let mut entries = Vec::with_capacity(count.min(bytes.len() / SHORTEST) * banner.copies());
    let mut found = 0;
    for (line, text) in lines {
        reader.read(line, text, &mut entries)?;
        found += 1;
    }
    if found != count {
        return Err(input_error!("crossbar::matrix_market::count" =>
            "expected {count} entries as line {size_line} says, found {found}"; help "is the file cut?")
        .at(name));
    }
    entries.sort_unstable_by_key(|&(row, column, _)| (row, column));
    if let Some(pair) = entries.windows(2).find(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
        return Err(input_error!("crossbar::matrix_market::twice" =>
            "expected one entry for row {}, column {}, found two", pair[0].0 + 1, pair[0].1 + 1;
            help "add the entries up, or leave one out")
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

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Symmetry {
    General,
    Symmetric,
    Skew,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Field {
    Real,
    Integer,
    Pattern,
}

#[derive(Clone, Copy, Debug)]
struct Banner {
    field: Field,
    symmetry: Symmetry,
}

impl Banner {
    fn parse(line: &[u8]) -> Option<Self> {
        let line = String::from_utf8_lossy(line).to_lowercase();
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        let ["%%matrixmarket", "matrix", "coordinate", field, symmetry] = words[..] else { return None };
        let field = match field {
            "real" | "double" => Field::Real,
            "integer" => Field::Integer,
            "pattern" => Field::Pattern,
            _ => return None,
        };
        let symmetry = match symmetry {
            "general" => Symmetry::General,
            "symmetric" => Symmetry::Symmetric,
            // A `pattern` matrix, whose entries are all 1, cannot be skew-symmetric.
            "skew-symmetric" if field != Field::Pattern => Symmetry::Skew,
            _ => return None,
        };
        Some(Self { field, symmetry })
    }

    /// Largest number of matrix entries that one line describes.
    fn copies(self) -> usize {
        if self.symmetry == Symmetry::General { 1 } else { 2 }
    }
}

/// Numbers of rows, columns and entries; rows and columns are within 32 bits.
fn sizes(line: &[u8]) -> Option<[usize; 3]> {
    let [rows, columns, count] = words(line)[..] else { return None };
    let [rows, columns, count] = [whole(rows)?, whole(columns)?, whole(count)?];
    let nameable = |size: usize| (1..=u32::MAX as usize).contains(&size);
    (nameable(rows) && nameable(columns)).then_some([rows, columns, count])
}

fn whole(word: &[u8]) -> Option<usize> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

fn integer(word: &[u8]) -> Option<f64> {
    let exact: i128 = std::str::from_utf8(word).ok()?.parse().ok()?;
    let number = exact as f64;
    (number as i128 == exact).then_some(number)
}

struct EntryReader<'a> {
    name: &'a Path,
    banner: Banner,
    size: [usize; 2],
}

impl EntryReader<'_> {
    fn read(&self, line: usize, text: &[u8], into: &mut Vec<(u32, u32, f64)>) -> Result<(), InputError> {
        let entry = |expected: &'static str, found: &[u8]| {
            input_error!("crossbar::matrix_market::entry" =>
                "expected {expected}, found {}", quoted(found);
                help "a line `row column value` per entry, counted from 1")
            .at(FilePlace::line(self.name, line))
        };
        let mut words = text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let (row, column) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
        let is_pattern = self.banner.field == Field::Pattern;
        let value = if is_pattern { Some(&b"1"[..]) } else { words.next() };
        let (Some(value), None) = (value, words.next()) else {
            let expected = if is_pattern { "a row and a column" } else { "a row, a column and a value" };
            return Err(entry(expected, text.trim_ascii()));
        };
        let row = self.place(line, "row", row, self.size[0])?;
        let column = self.place(line, "column", column, self.size[1])?;
        let number = match self.banner.field {
            Field::Integer => {
                integer(value).ok_or_else(|| entry("an integer that a 64-bit float holds exactly", value))?
            }
            _ => {
                let number = double(value).map_err(|fault| entry(fault.expected(), value))?;
                let digits = value.split(|byte| byte.eq_ignore_ascii_case(&b'e')).next().unwrap_or_default();
                if number == 0.0 && digits.iter().any(|digit| (b'1'..=b'9').contains(digit)) {
                    return Err(entry("a number that a 64-bit float does not round to 0", value));
                }
                number
            }
        };
        if self.banner.symmetry == Symmetry::Skew && row == column {
            return Err(entry("a place off the diagonal, where a skew-symmetric matrix is 0", text.trim_ascii()));
        }
        into.push((row, column, number));
        if self.banner.symmetry != Symmetry::General && row != column {
            into.push((column, row, if self.banner.symmetry == Symmetry::Skew { -number } else { number }));
        }
        Ok(())
    }

    /// Parses a row or column index and counts it from 0.
    fn place(&self, line: usize, what: &'static str, found: &[u8], most: usize) -> Result<u32, InputError> {
        let place = whole(found).filter(|place| (1..=most).contains(place));
        let wrong = || {
            input_error!("crossbar::matrix_market::place" =>
                "expected a {what} from 1 to {most}, found {}", quoted(found); help "rows and columns count from 1")
            .at(FilePlace::line(self.name, line))
        };
        place.map(|place| (place - 1) as u32).ok_or_else(wrong)
    }
}
