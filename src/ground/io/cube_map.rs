//! Cube maps as a comma-separated table: the header `face,row,column,r,g,b`, then a line per texel, in any order.
//!
//! Faces are Direct3D's, 0 to 5 or +x, -x, +y, -y, +z, -z, as they look from inside the cube; rows count from the top,
//! columns from the left, from 0. Radiances are finite; those of truncated
//! light may lie below 0.

use std::fmt::Write as _;
use std::path::Path;

use super::error::read_file;
use super::headed_table::{for_each_row, whole};
use super::quoted;
use crate::error::{InputError, ensure, input_error};

/// Longest file that is read, in bytes (64 MiB).
pub const MAX_BYTES: u64 = 1 << 26;
const HEADER: [&str; 6] = ["face", "row", "column", "r", "g", "b"];
const FACES: [&str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];

/// Reads the texels of a cube map of a side from a file, by face, row and column.
///
/// # Errors
/// [`InputError`], with the path, and the line where there is one.
pub fn load_cube_table(path: &Path, side: usize) -> Result<Vec<[f64; 3]>, InputError> {
    parse_cube_table(&read_file(path, "table of light", MAX_BYTES)?, path, side)
}

/// Reads the texels of a cube map from bytes; `name` is the file's name in messages.
///
/// # Errors
/// [`InputError`], with the line where there is one.
///
/// # Panics
/// If the side is 0.
pub fn parse_cube_table(bytes: &[u8], name: &Path, side: usize) -> Result<Vec<[f64; 3]>, InputError> {
    assert!(side > 0, "a texel along an edge");
    let place_of = |at: usize| [at / (side * side), at / side % side, at % side];
    // Each texel with its line; 0 while there is none.
    let mut texels = vec![([0.0; 3], 0); 6 * side * side];
    for_each_row(bytes, name, &HEADER, "texel", &mut |line, record| {
        let (at, radiance) = parse_texel(record, side)?;
        let [face, row, column] = place_of(at);
        let (_, first) = texels[at];
        ensure!(first == 0, "crossbar::cube_map::twice" =>
            "the texel at face {face}, row {row}, column {column} stands on line {first} too";
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
             {column}"; help "give every texel one line; black ones too")
        .at(name));
    }
    Ok(texels.into_iter().map(|(radiance, _)| radiance).collect())
}

/// The table of a cube map's texels, in their order.
///
/// # Panics
/// If there are not the texels of six faces of this side.
pub fn write_cube_table(texels: &[[f64; 3]], side: usize) -> String {
    assert_eq!(texels.len(), 6 * side * side, "six faces of side {side}");
    let mut text = HEADER.join(",") + "\n";
    for (at, [r, g, b]) in texels.iter().enumerate() {
        let [face, row, column] = [at / (side * side), at / side % side, at % side];
        let _ = writeln!(text, "{face},{row},{column},{r},{g},{b}");
    }
    text
}

/// The number of a row's texel, and its radiance.
fn parse_texel(record: &csv::ByteRecord, side: usize) -> Result<(usize, [f64; 3]), InputError> {
    let fields: Vec<&[u8]> = record.iter().collect();
    let [face, row, column, r, g, b] = fields[..] else {
        return Err(input_error!("crossbar::cube_map::fields" =>
            "expected six fields (face,row,column,r,g,b), found {}", whole(record)));
    };
    let text = |field| std::str::from_utf8(field).unwrap_or_default();
    let named = FACES.iter().position(|name| name.as_bytes() == face);
    let face = named.or_else(|| text(face).parse().ok().filter(|face| *face < 6)).ok_or_else(|| {
        input_error!("crossbar::cube_map::face" =>
            "expected a face, 0 to 5 or +x, -x, +y, -y, +z, -z; found {}", quoted(face))
    })?;
    let number = |what, field| {
        text(field).parse().ok().filter(|at| *at < side).ok_or_else(|| {
            input_error!("crossbar::cube_map::place" =>
                "expected a {what} from 0 to {}, found {}", side - 1, quoted(field);
                help "the map has six faces of {side} x {side} texels")
        })
    };
    let (row, column): (usize, usize) = (number("row", row)?, number("column", column)?);
    let radiance = |channel, field| {
        text(field).parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| {
            input_error!("crossbar::cube_map::radiance" =>
                "expected a finite number for `{channel}`, found {}", quoted(field))
        })
    };
    Ok(((face * side + row) * side + column, [radiance("r", r)?, radiance("g", g)?, radiance("b", b)?]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Vec<[f64; 3]>, String> {
        parse_cube_table(text.as_bytes(), Path::new("l.csv"), 1).map_err(|error| error.to_string())
    }

    const TAIL: &str = "1,0,0,1,0,0\n2,0,0,2,0,0\n3,0,0,3,0,0\n-z,0,0,5,0,0\n+z,0,0,4,0,0.5\n";

    #[test]
    fn a_line_is_a_texel_in_any_order() {
        let texels = parse(&format!("face,row,column,r,g,b\n{TAIL}+x,0,0, 0.25 ,1e3,0\n")).expect("a map");
        assert_eq!(texels[0], [0.25, 1000.0, 0.0]);
        assert_eq!(texels[4..], [[4.0, 0.0, 0.5], [5.0, 0.0, 0.0]]);
        assert_eq!(parse(&write_cube_table(&texels, 1)), Ok(texels.clone()));
        let signed: Vec<[f64; 3]> = texels.iter().map(|rgb| rgb.map(|value| -value)).collect();
        assert_eq!(parse(&write_cube_table(&signed, 1)), Ok(signed));
    }

    #[test]
    fn bad_tables_are_named() {
        let error = |line: &str| parse(&format!("face,row,column,r,g,b\n{TAIL}{line}\n")).expect_err("no map");
        assert_eq!(parse(""), Err("l.csv:1: expected the header `face,row,column,r,g,b`, found ``".to_owned()));
        assert_eq!(error("0,0,0,1,1"), "l.csv:7: expected six fields (face,row,column,r,g,b), found `0,0,0,1,1`");
        let faces = "l.csv:7: expected a face, 0 to 5 or +x, -x, +y, -y, +z, -z; found";
        assert_eq!(error("6,0,0,1,1,1"), format!("{faces} `6`"));
        assert_eq!(error("up,0,0,1,1,1"), format!("{faces} `up`"));
        assert_eq!(error("0,1,0,1,1,1"), "l.csv:7: expected a row from 0 to 0, found `1`");
        assert_eq!(error("0,0,-1,1,1,1"), "l.csv:7: expected a column from 0 to 0, found `-1`");
        let radiance = "l.csv:7: expected a finite number for";
        assert_eq!(error("0,0,0,1,nan,1"), format!("{radiance} `g`, found `nan`"));
        assert_eq!(error("0,0,0,1,1,x"), format!("{radiance} `b`, found `x`"));
        assert_eq!(error("0,0,0,inf,1,1"), format!("{radiance} `r`, found `inf`"));
        assert_eq!(error("1,0,0,1,1,1"), "l.csv:7: the texel at face 1, row 0, column 0 stands on line 2 too");
        let missing = "l.csv: expected 6 texels, 1 of them are missing, the first at face 0, row 0, column 0";
        assert_eq!(error(""), missing);
    }
}
