//! Files of measured pixels: comma-separated tables.
//!
//! The header names the columns, in any order: `case`, `column` and `row` are required; `red`, `green`, `blue`, `alpha`
//! and `depth` are optional, and so is every value in them. A case is a path relative to the folder of the table. Codes
//! are the stored integers: `red` to `alpha` are the first to fourth stored channel of target 0, as in a probe's `raw`.
//! A line that begins with `#` is a remark: the card, and probes that it could not draw.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::io::read_limited;
use crate::study::StudyError;

/// Longest file that is read, in bytes (64 MiB).
const MAX_BYTES: u64 = 1 << 26;
const HELP: &str = "the header is `case,column,row,red,green,blue,alpha,depth`; docs/measuring.md describes the table";

/// Columns of codes.
pub(super) const CODES: [&str; 5] = ["red", "green", "blue", "alpha", "depth"];

/// Pixel that a card drew.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeasuredPixel {
    /// Line of the table, from 1.
    pub line: u64,
    /// Column and row, counted from 0 at the top left.
    pub place: [u32; 2],
    /// Stored codes of the channels of target 0, then of the depth buffer, as far as they were measured.
    pub codes: [Option<u32>; 5],
}

impl MeasuredPixel {
    /// Measured codes: index of the column among [`CODES`], and the code.
    pub(super) fn measured(&self) -> impl Iterator<Item = (usize, u32)> {
        self.codes.into_iter().enumerate().filter_map(|(at, code)| Some((at, code?)))
    }
}

/// Measured pixels of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeasuredCase {
    /// Case that the card drew.
    pub path: PathBuf,
    /// Pixels, in the order of the table; never empty.
    pub pixels: Vec<MeasuredPixel>,
}

/// Line of the table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    case: PathBuf,
    column: u32,
    row: u32,
    red: Option<u32>,
    green: Option<u32>,
    blue: Option<u32>,
    alpha: Option<u32>,
    depth: Option<u32>,
}

/// Reads measured pixels from a file. Fails if the file cannot be read, is too long or is not such a table: the message
/// has the path and the line.
pub fn load_measurement(path: &Path) -> Result<Vec<MeasuredCase>, StudyError> {
    let unreadable = |source| {
        StudyError::new("crossbar::measure::file", format!("cannot read the measured pixels {}", path.display()))
            .with_help("check the path, and that you may read the file")
            .with_source(source)
    };
    let Some(bytes) = read_limited(path, MAX_BYTES).map_err(unreadable)? else {
        let found = format!("{}: expected a table of at most {MAX_BYTES} bytes, found more", path.display());
        return Err(StudyError::new("crossbar::measure::file", found).with_help("split the pixels into several files"));
    };
    parse_measurement(&bytes, path)
}

/// Reads measured pixels from bytes; `name` is the path of the file, to which paths of cases are relative. Fails if it
/// is not such a table, or has no pixels.
pub fn parse_measurement(bytes: &[u8], name: &Path) -> Result<Vec<MeasuredCase>, StudyError> {
    let wrong = |line: u64, found: String| {
        StudyError::new("crossbar::measure::table", format!("{}:{line}: {found}", name.display())).with_help(HELP)
    };
    let broken = |error: csv::Error| {
        let line = error.position().map_or(1, |position| line_of(bytes, position));
        let found = match error.into_kind() {
            csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                format!("expected {expected_len} fields, found {len}")
            }
            csv::ErrorKind::Deserialize { err, .. } => format!("expected a line of measured pixels: {err}"),
            other => format!("expected a table: {other:?}"),
        };
        wrong(line, found)
    };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(bytes);
    let headers = reader.headers().map_err(broken)?.clone();
    let folder = name.parent().unwrap_or_else(|| Path::new(""));
    let mut cases: Vec<MeasuredCase> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(broken)?;
        let line = record.position().map_or(0, |position| line_of(bytes, position));
        let row: Row = record.deserialize(Some(&headers)).map_err(broken)?;
        let codes = [row.red, row.green, row.blue, row.alpha, row.depth];
        if codes == [None; 5] {
            return Err(wrong(line, "expected a measured code, found none".to_owned()));
        }
        let pixel = MeasuredPixel { line, place: [row.column, row.row], codes };
        let path = folder.join(row.case);
        match cases.iter_mut().find(|case| case.path == path) {
            Some(case) => case.pixels.push(pixel),
            None => cases.push(MeasuredCase { path, pixels: vec![pixel] }),
        }
    }
    if cases.is_empty() {
        return Err(wrong(1, "expected measured pixels, found a table without lines".to_owned()));
    }
    Ok(cases)
}

/// Line of the record read from a position, which may precede remarks and empty lines before the record.
fn line_of(bytes: &[u8], position: &csv::Position) -> u64 {
    let start = usize::try_from(position.byte()).unwrap_or(usize::MAX);
    let lines = bytes.get(start..).unwrap_or_default().split(|byte| *byte == b'\n');
    let skipped = lines.take_while(|line| line.first().is_none_or(|first| matches!(first, b'#' | b'\r'))).count();
    position.line() + skipped as u64
}
