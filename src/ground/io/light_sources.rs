//! Lists of small light sources as a comma-separated table: the header `x,y,z,degrees,r,g,b`, then a line per source:
//! the direction towards it, its angular radius in degrees, its radiance.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::error::ReadError;
use super::{quoted, read_limited};

/// Longest file that is read, in bytes (16 MiB).
pub const MAX_BYTES: u64 = 1 << 24;
const HEADER: [&str; 7] = ["x", "y", "z", "degrees", "r", "g", "b"];

/// A line of the table, its numbers finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSourceRow {
    /// Towards the source.
    pub towards: [f64; 3],
    /// Angular radius in degrees.
    pub degrees: f64,
    /// Radiance: red, green, blue.
    pub radiance: [f64; 3],
}

/// Errors of reading a list of sources. Lines count from 1, the header's.
#[non_exhaustive]
#[derive(Debug, Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum LightSourcesError {
    /// The file is not there, or too long.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Read(#[from] ReadError),
    /// The first line is not the header.
    #[error("{}:1: expected the header `x,y,z,degrees,r,g,b`, found {found}", path.display())]
    #[diagnostic(code(crossbar::light_sources::header), help("a line `x,y,z,degrees,r,g,b`, then a line per source"))]
    Header { path: PathBuf, found: String },
    /// A line that is not a valid source.
    #[error(
        "{}:{line}: expected seven finite numbers (x,y,z,degrees,r,g,b), a direction other than 0, degrees above 0 and \
         up to 180, radiances of at least 0; found {found}", path.display()
    )]
    #[diagnostic(code(crossbar::light_sources::numbers))]
    Numbers { path: PathBuf, line: u64, found: String },
    /// The table's syntax is broken.
    #[error("{}: the table cannot be read: {reason}", path.display())]
    #[diagnostic(code(crossbar::light_sources::syntax))]
    Syntax { path: PathBuf, reason: String },
}

/// Reads sources from a file.
///
/// # Errors
/// [`LightSourcesError`], with the path, and the line where there is one.
pub fn load_light_sources(path: &Path) -> Result<Vec<LightSourceRow>, LightSourcesError> {
    let unreadable = |source| ReadError::Unreadable { what: "light sources", path: path.into(), source };
    match read_limited(path, MAX_BYTES).map_err(unreadable)? {
        Some(bytes) => parse_light_sources(&bytes, path),
        None => Err(ReadError::TooLong { what: "table", path: path.into(), limit: MAX_BYTES }.into()),
    }
}

/// Reads sources from bytes; `name` is the file's name in messages.
///
/// # Errors
/// [`LightSourcesError`], with the line where there is one.
pub fn parse_light_sources(bytes: &[u8], name: &Path) -> Result<Vec<LightSourceRow>, LightSourcesError> {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).trim(csv::Trim::All).from_reader(bytes);
    let syntax = |reason: csv::Error| LightSourcesError::Syntax { path: name.into(), reason: reason.to_string() };
    let text = |record: &csv::ByteRecord| quoted(&record.iter().collect::<Vec<_>>().join(&b','));
    let mut record = csv::ByteRecord::new();
    let has_header = reader.read_byte_record(&mut record).map_err(syntax)?;
    if !has_header || !record.iter().eq(HEADER.map(str::as_bytes)) {
        return Err(LightSourcesError::Header { path: name.into(), found: text(&record) });
    }
    let mut found = Vec::new();
    while reader.read_byte_record(&mut record).map_err(syntax)? {
        let line = record.position().map_or(0, csv::Position::line);
        let row = row(&record);
        found.push(row.ok_or_else(|| LightSourcesError::Numbers { path: name.into(), line, found: text(&record) })?);
    }
    Ok(found)
}

fn row(record: &csv::ByteRecord) -> Option<LightSourceRow> {
    let number = |field: &[u8]| std::str::from_utf8(field).ok()?.parse().ok().filter(|value: &f64| value.is_finite());
    let numbers: Vec<f64> = record.iter().map(number).collect::<Option<_>>()?;
    let [x, y, z, degrees, r, g, b] = numbers[..] else { return None };
    let row = LightSourceRow { towards: [x, y, z], degrees, radiance: [r, g, b] };
    let is_source = row.towards != [0.0; 3] && degrees > 0.0 && degrees <= 180.0;
    (is_source && row.radiance.iter().all(|channel| *channel >= 0.0)).then_some(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Vec<LightSourceRow>, String> {
        parse_light_sources(text.as_bytes(), Path::new("s.csv")).map_err(|error| error.to_string())
    }

    #[test]
    fn a_line_is_a_source() {
        let expected = LightSourceRow { towards: [0.0, 0.0, 2.0], degrees: 1.5, radiance: [1.0, 2.0, 3.0] };
        assert_eq!(parse("x,y,z,degrees,r,g,b\n0,0,2,1.5,1,2,3\n"), Ok(vec![expected]));
        assert_eq!(parse("x,y,z,degrees,r,g,b\n"), Ok(vec![]));
    }

    #[test]
    fn bad_lists_are_named() {
        assert_eq!(
            parse("0,0,1,1,1,1,1\n"),
            Err("s.csv:1: expected the header `x,y,z,degrees,r,g,b`, found `0,0,1,1,1,1,1`".to_owned())
        );
        for line in ["0,0,0,1,1,1,1", "0,0,1,0,1,1,1", "0,0,1,181,1,1,1", "0,0,1,1,-1,1,1", "0,0,1,1,nan,1,1", "0,0,1"]
        {
            let error = parse(&format!("x,y,z,degrees,r,g,b\n{line}\n")).expect_err(line);
            assert!(
                error.starts_with("s.csv:2: expected seven finite numbers") && error.ends_with(&format!("`{line}`")),
                "{error}"
            );
        }
    }
}
