//! Cube maps as a comma-separated table: the header `face,row,column,r,g,b`, then a line per texel, in any order.
//!
//! Faces are Direct3D's, 0 to 5 for +x, -x, +y, -y, +z, -z, as seen from inside the cube; rows count from the top,
//! columns from the left, from 0. Radiances are finite; a truncated expansion of light may give values below 0.

use std::fmt::Write as _;
use std::path::Path;

use super::error::read_file;
use super::headed_table::{finite, for_each_row, whole};
use crate::error::{InputError, ensure, input_error};

/// Longest file that is read, in bytes (64 MiB).
pub const MAX_BYTES: u64 = 1 << 26;
const HEADER: [&str; 6] = ["face", "row", "column", "r", "g", "b"];

/// Reads the texels of a cube map from a file, by face, row and column.
pub fn load_cube_table(path: &Path, side: usize) -> Result<Vec<[f64; 3]>, InputError> {
    parse_cube_table(&read_file(path, "table of light", MAX_BYTES)?, path, side)
}

/// Reads the texels of a cube map from bytes; `name` is the file's name in messages.
pub fn parse_cube_table(bytes: &[u8], name: &Path, side: usize) -> Result<Vec<[f64; 3]>, InputError> {
    assert!(side > 0, "a texel along an edge");
    let place_of = |at: usize| [at / (side * side), at / side % side, at % side];
    // Each texel with its line in the file; line 0 until it is read.
    let mut texels = vec![([0.0; 3], 0); 6 * side * side];
    for_each_row(bytes, name, &HEADER, "texel", &mut |line, record| {
        let (at, radiance) = parse_texel(record, side).ok_or_else(|| {
            input_error!("crossbar::cube_map::fields" =>
                "expected a face from 0 to 5, a row and a column from 0 to {}, and three finite numbers; found {}",
                side - 1, whole(record); help "the map has six faces of {side} x {side} texels")
        })?;
        let [face, row, column] = place_of(at);
        let (_, first) = texels[at];
        ensure!(first == 0, "crossbar::cube_map::twice" =>
            "the texel at face {face}, row {row}, column {column} is on line {first}, too";
            help "give every texel one line");
        texels[at] = (radiance, line);
        Ok(())
    })?;
    let is_missing = |(_, line): &([f64; 3], usize)| *line == 0;
    if let Some(at) = texels.iter().position(is_missing) {
        let (expected, missing) = (texels.len(), texels.iter().filter(|texel| is_missing(texel)).count());
        let [face, row, column] = place_of(at);
        return Err(input_error!("crossbar::cube_map::missing" =>
            "expected {expected} texels, {missing} of them are missing, the first at face {face}, row {row}, column \
             {column}"; help "give every texel one line, even if it is black")
        .at(name));
    }
    Ok(texels.into_iter().map(|(radiance, _)| radiance).collect())
}

/// The table of a cube map's texels, in their order. Panics unless there are 6 `side`^2 texels.
pub fn write_cube_table(texels: &[[f64; 3]], side: usize) -> String {
    assert_eq!(texels.len(), 6 * side * side, "six faces of side {side}");
    let mut text = HEADER.join(",") + "\n";
    for (at, [r, g, b]) in texels.iter().enumerate() {
        let [face, row, column] = [at / (side * side), at / side % side, at % side];
        let _ = writeln!(text, "{face},{row},{column},{r},{g},{b}");
    }
    text
}

fn parse_texel(record: &csv::ByteRecord, side: usize) -> Option<(usize, [f64; 3])> {
    let [face, row, column, r, g, b] = finite(record)?;
    let place = |at: f64, count: usize| (0..count).find(|&place| place as f64 == at);
    Some(((place(face, 6)? * side + place(row, side)?) * side + place(column, side)?, [r, g, b]))
}
