//! Rays and hits as comma-separated tables.
//!
//! Rays: the header `ox,oy,oz,dx,dy,dz`, then one ray per line. Numbers are rounded to the nearest f32; directions are
//! not renormalised. Numbers that are not finite or overflow f32, and zero directions, are rejected.
//!
//! Hits: the header `ray,triangle,t`, then a line per ray in the order of the rays. `triangle` counts from 0 in the
//! order of the mesh file; without a hit it is -1 and `t` is `inf`. `t` is the shortest decimal that reads back to the
//! same f32, or beyond f32 to the same f64. If a card's format overflows at a smaller value, a hit has the `inf` that
//! the card computed.

use std::io::{self, Read, Write};
use std::path::Path;

use super::lines::single;
use super::{NumberError, open_limited, quoted};
use crate::error::{FilePlace, InputError, input_error};
use crate::geom::Ray;
use crate::io::error::{too_long_error, unreadable_error};

/// Longest file that is read, in bytes (1 GiB).
pub const MAX_BYTES: u64 = 1 << 30;

/// Largest length of the first line, in bytes.
const MAX_HEADER_BYTES: u64 = 4096;

/// The columns of a ray table.
const HEADER: [&str; 6] = ["ox", "oy", "oz", "dx", "dy", "dz"];

fn header_error(name: &Path, found: &str) -> InputError {
    input_error!("expected the header `ox,oy,oz,dx,dy,dz`, found {found}").at(FilePlace::line(name, 1))
}

/// Reads rays from a file. Fails with an [`InputError`] that names the path and, where known, the line.
pub fn load_rays(path: &Path) -> Result<Vec<Ray>, InputError> {
    let mut limited = open_limited(path, MAX_BYTES).map_err(|source| unreadable(path, source))?;
    let rays = read_rays(&mut limited, path);
    // A table that exceeds the limit is cut there, which may break a row.
    if limited.limit() == 0 { Err(too_long_error("table", path, MAX_BYTES)) } else { rays }
}

fn unreadable(path: &Path, source: io::Error) -> InputError {
    unreadable_error("rays", path, source)
}

/// Reads rays from bytes; `name` is the file's name in messages. A table without rays is valid.
pub fn parse_rays(bytes: &[u8], name: &Path) -> Result<Vec<Ray>, InputError> {
    read_rays(bytes, name)
}

fn read_rays(mut input: impl Read, name: &Path) -> Result<Vec<Ray>, InputError> {
    let mut head = Vec::new();
    input.by_ref().take(MAX_HEADER_BYTES).read_to_end(&mut head).map_err(|source| unreadable(name, source))?;
    // A file of another format may be a single line of any length.
    if head.len() as u64 == MAX_HEADER_BYTES && !head.contains(&b'\n') {
        return Err(header_error(name, &quoted(&head)));
    }
    let input = io::Cursor::new(head).chain(input);
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).trim(csv::Trim::All).from_reader(input);
    let broken = |reason: csv::Error| match reason.into_kind() {
        csv::ErrorKind::Io(source) => unreadable(name, source),
        other => input_error!("the table cannot be read: {other:?}").at(name),
    };
    let mut record = csv::ByteRecord::new();
    reader.read_byte_record(&mut record).map_err(broken)?;
    if !record.iter().eq(HEADER.map(str::as_bytes)) {
        let found = record.iter().collect::<Vec<_>>().join(&b',');
        return Err(header_error(name, &quoted(&found)));
    }
    let mut rays: Vec<Ray> = Vec::new();
    while reader.read_byte_record(&mut record).map_err(broken)? {
        rays.try_reserve(1).map_err(|_| input_error!("no memory for more than {} rays", rays.len()).at(name))?;
        rays.push(ray(&record, name)?);
    }
    Ok(rays)
}

fn ray(record: &csv::ByteRecord, name: &Path) -> Result<Ray, InputError> {
    let line = record.position().map_or(0, |position| position.line() as usize);
    if record.len() != HEADER.len() {
        return Err(input_error!(
            "expected 6 numbers (ox,oy,oz,dx,dy,dz), found {} {}",
            record.len(),
            if record.len() == 1 { "field" } else { "fields" }
        )
        .at(FilePlace::line(name, line)));
    }
    let mut numbers = [0.0_f32; 6];
    for ((number, field), column) in numbers.iter_mut().zip(record).zip(HEADER) {
        let wrong = |reason: NumberError| {
            input_error!("expected {} for {column}, found {}", reason.expected(), quoted(field))
                .at(FilePlace::line(name, line))
        };
        *number = single(field).map_err(wrong)?;
    }
    let [ox, oy, oz, dx, dy, dz] = numbers;
    Ray::new([ox, oy, oz], [dx, dy, dz]).map_err(|reason| reason.at(FilePlace::line(name, line)))
}

/// Writes one line per ray: its number from 0, the triangle or -1, and t or `inf`.
pub fn write_hits(hits: &[Option<(u32, f64)>], out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "ray,triangle,t")?;
    for (ray, hit) in hits.iter().enumerate() {
        match *hit {
            Some((triangle, t)) if t.is_finite() && (t as f32).is_infinite() => {
                writeln!(out, "{ray},{triangle},{t:e}")?
            }
            Some((triangle, t)) => writeln!(out, "{ray},{triangle},{}", t as f32)?,
            None => writeln!(out, "{ray},-1,inf")?,
        }
    }
    Ok(())
}
