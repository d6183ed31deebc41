//! Lists of small light sources as a comma-separated table: the header `x,y,z,degrees,r,g,b`, then a line per source:
//! the direction towards it, its angular radius in degrees, its radiance.

use std::path::Path;

use super::error::read_file;
use super::headed_table::{finite, for_each_row, whole};
use crate::error::{InputError, input_error};

/// Longest file that is read, in bytes (16 MiB).
pub const MAX_BYTES: u64 = 1 << 24;
const HEADER: [&str; 7] = ["x", "y", "z", "degrees", "r", "g", "b"];

/// A row of the table; all numbers are finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSourceRow {
    /// Direction towards the source.
    pub towards: [f64; 3],
    /// Angular radius in degrees.
    pub degrees: f64,
    /// Radiance: red, green, blue.
    pub radiance: [f64; 3],
}

/// Reads sources from a file. Fails with an [`InputError`] that names the path and, where known, the line.
pub fn load_light_sources(path: &Path) -> Result<Vec<LightSourceRow>, InputError> {
    parse_light_sources(&read_file(path, "table of light sources", MAX_BYTES)?, path)
}

/// Reads sources from bytes; `name` is the file's name in messages.
pub fn parse_light_sources(bytes: &[u8], name: &Path) -> Result<Vec<LightSourceRow>, InputError> {
    let mut found = Vec::new();
    for_each_row(bytes, name, &HEADER, "source", &mut |_, record| {
        found.push(row(record).ok_or_else(|| {
            input_error!("crossbar::light_sources::numbers" =>
                "expected seven finite numbers (x,y,z,degrees,r,g,b), a direction other than 0, degrees above 0 and \
                 up to 180, radiances of at least 0; found {}", whole(record))
        })?);
        Ok(())
    })?;
    Ok(found)
}

fn row(record: &csv::ByteRecord) -> Option<LightSourceRow> {
    let [x, y, z, degrees, r, g, b] = finite(record)?;
    let row = LightSourceRow { towards: [x, y, z], degrees, radiance: [r, g, b] };
    let is_source = row.towards != [0.0; 3] && degrees > 0.0 && degrees <= 180.0;
    (is_source && row.radiance.iter().all(|channel| *channel >= 0.0)).then_some(row)
}
