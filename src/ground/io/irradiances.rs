//! Irradiances of faces as a comma-separated table: the header `r,g,b`, then a line per face in the order of the mesh.
//! Numbers are from 0 to [`MAX_IRRADIANCE`].

use std::path::Path;

use super::{quoted, read_limited};
use crate::error::{FilePlace, InputError, input_error};
use crate::io::error::{too_long_error, unreadable_error};

/// Longest file that is read, in bytes (256 MiB).
pub const MAX_BYTES: u64 = 1 << 28;

/// The largest irradiance: sums of it times any throughput are still far from the range of single floats.
pub const MAX_IRRADIANCE: f64 = 1e30;

fn header_error(name: &Path, found: &str) -> InputError {
    input_error!("irradiances::header" =>
        "expected the header `r,g,b`, found {found}"; help "a line `r,g,b`, then a line of three numbers per face")
    .at(FilePlace::line(name, 1))
}

/// Reads irradiances from a file, one per face.
///
/// # Errors
/// [`InputError`], with the path, and the line where there is one.
pub fn load_irradiances(path: &Path) -> Result<Vec<[f64; 3]>, InputError> {
    let unreadable = |source| unreadable_error("irradiances", path, source);
    match read_limited(path, MAX_BYTES).map_err(unreadable)? {
        Some(bytes) => parse_irradiances(&bytes, path),
        None => Err(too_long_error("table", path, MAX_BYTES)),
    }
}

/// Reads irradiances from bytes; `name` is the file's name in messages.
///
/// # Errors
/// [`InputError`], with the line where there is one.
pub fn parse_irradiances(bytes: &[u8], name: &Path) -> Result<Vec<[f64; 3]>, InputError> {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).trim(csv::Trim::All).from_reader(bytes);
    let mut found = Vec::new();
    for (at, record) in reader.byte_records().enumerate() {
        let record = record
            .map_err(|reason| input_error!("irradiances::table" => "the table cannot be read: {reason}").at(name))?;
        let line = record.position().map_or(0, csv::Position::line);
        let text = || quoted(&record.iter().collect::<Vec<_>>().join(&b','));
        if at == 0 {
            if !record.iter().eq(["r", "g", "b"].map(str::as_bytes)) {
                return Err(header_error(name, &text()));
            }
            continue;
        }
        let number = |field: &[u8]| -> Option<f64> {
            let value: f64 = std::str::from_utf8(field).ok()?.parse().ok()?;
            (0.0..=MAX_IRRADIANCE).contains(&value).then_some(value)
        };
        let numbers: Option<Vec<f64>> = record.iter().map(number).collect();
        match numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok()) {
            Some(irradiance) => found.push(irradiance),
            None => {
                return Err(input_error!("irradiances::numbers" =>
                    "expected three numbers from 0 to {MAX_IRRADIANCE:e} (r,g,b), found {}", text())
                .at(FilePlace::line(name, line as usize)));
            }
        }
    }
    if found.is_empty() && !bytes.starts_with(b"r") {
        return Err(header_error(name, &quoted(bytes)));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Vec<[f64; 3]>, String> {
        parse_irradiances(text.as_bytes(), Path::new("e.csv")).map_err(|error| error.to_string())
    }

    #[test]
    fn a_line_is_a_face() {
        assert_eq!(parse("r,g,b\n1, 0.5,0\n0,0,2e3\n"), Ok(vec![[1.0, 0.5, 0.0], [0.0, 0.0, 2000.0]]));
        assert_eq!(parse("r,g,b\n"), Ok(vec![]));
    }

    #[test]
    fn bad_tables_are_named() {
        let numbers = "expected three numbers from 0 to 1e30 (r,g,b), found";
        assert_eq!(parse("1,2,3\n"), Err("e.csv:1: expected the header `r,g,b`, found `1,2,3`".to_owned()));
        assert_eq!(parse(""), Err("e.csv:1: expected the header `r,g,b`, found ``".to_owned()));
        assert_eq!(parse("r,g,b\n1,2\n"), Err(format!("e.csv:2: {numbers} `1,2`")));
        assert_eq!(parse("r,g,b\n1,2,-3\n"), Err(format!("e.csv:2: {numbers} `1,2,-3`")));
        assert_eq!(parse("r,g,b\n1,1e300,3\n"), Err(format!("e.csv:2: {numbers} `1,1e300,3`")));
        assert_eq!(parse("r,g,b\n1,2,nan\n"), Err(format!("e.csv:2: {numbers} `1,2,nan`")));
    }
}
