//! Irradiances of faces as a comma-separated table: the header `r,g,b`, then a line per face in the order of the mesh.
//! Numbers are from 0 to [`MAX_IRRADIANCE`].

use std::path::Path;

use super::error::read_file;
use super::headed_table::{finite, for_each_row, whole};
use crate::error::{InputError, input_error};

/// Longest file that is read, in bytes (256 MiB).
pub const MAX_BYTES: u64 = 1 << 28;

/// The largest irradiance: sums of it times any throughput are still far from the range of single floats.
pub const MAX_IRRADIANCE: f64 = 1e30;

/// Reads irradiances from a file, one per face.
///
/// # Errors
/// [`InputError`], with the path, and the line where there is one.
pub fn load_irradiances(path: &Path) -> Result<Vec<[f64; 3]>, InputError> {
    parse_irradiances(&read_file(path, "table of irradiances", MAX_BYTES)?, path)
}

/// Reads irradiances from bytes; `name` is the file's name in messages.
///
/// # Errors
/// [`InputError`], with the line where there is one.
pub fn parse_irradiances(bytes: &[u8], name: &Path) -> Result<Vec<[f64; 3]>, InputError> {
    let mut found = Vec::new();
    for_each_row(bytes, name, &["r", "g", "b"], "face", &mut |_, record| {
        let in_range = |irradiance: &[f64; 3]| irradiance.iter().all(|value| (0.0..=MAX_IRRADIANCE).contains(value));
        found.push(finite(record).filter(in_range).ok_or_else(|| {
            input_error!("irradiances::numbers" =>
                "expected three numbers from 0 to {MAX_IRRADIANCE:e} (r,g,b), found {}", whole(record))
        })?);
        Ok(())
    })?;
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
