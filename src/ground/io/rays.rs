//! Rays and hits as comma-separated tables.
//!
//! Rays: the header `ox,oy,oz,dx,dy,dz`, then one ray per line. Numbers are rounded to the nearest f32; directions are
//! not renormalised. Numbers that are not finite or overflow f32, and zero directions, are rejected.
//!
//! Hits: the header `ray,triangle,t`, then a line per ray in their order. `triangle` counts from 0 in the order of the mesh file; without
//! a hit it is -1 and `t` is `inf`. `t` is the shortest decimal that reads back to the same f32, or beyond f32 to the
//! same f64. If a card's format overflows at a smaller value, a hit has the `inf` that the card computed.

use std::io::{self, Write};
use std::path::Path;

use super::error::read_file;
use super::headed_table::for_each_row;
use super::lines::single;
use super::quoted;
use crate::error::{InputError, ensure, input_error};
use crate::geom::Ray;

/// Longest file that is read, in bytes (1 GiB).
pub const MAX_BYTES: u64 = 1 << 30;

const HEADER: [&str; 6] = ["ox", "oy", "oz", "dx", "dy", "dz"];

/// Reads rays from a file.
pub fn load_rays(path: &Path) -> Result<Vec<Ray>, InputError> {
    parse_rays(&read_file(path, "table of rays", MAX_BYTES)?, path)
}

/// Reads rays from bytes; `name` is the file's name in messages. A table without rays is valid.
pub fn parse_rays(bytes: &[u8], name: &Path) -> Result<Vec<Ray>, InputError> {
    let mut rays: Vec<Ray> = Vec::new();
    for_each_row(bytes, name, &HEADER, "ray", &mut |_, record| {
        let fields = record.len();
        ensure!(fields == HEADER.len(), "crossbar::table::fields" =>
            "expected 6 numbers (ox,oy,oz,dx,dy,dz), found {fields} {}", if fields == 1 { "field" } else { "fields" });
        let mut numbers = [0.0_f32; 6];
        for ((number, field), column) in numbers.iter_mut().zip(record).zip(HEADER) {
            *number = single(field).map_err(|reason| {
                input_error!("crossbar::table::number" =>
                    "expected {} for {column}, found {}", reason.expected(), quoted(field))
            })?;
        }
        let [ox, oy, oz, dx, dy, dz] = numbers;
        rays.try_reserve(1).map_err(|_| input_error!("no memory for more than {} rays", rays.len()))?;
        rays.push(Ray::new([ox, oy, oz], [dx, dy, dz])?);
        Ok(())
    })?;
    Ok(rays)
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
