//! The verbs of `crossbar prt` for bi-scale transfer.

pub(super) mod bicluster;
pub(super) mod compare;
pub(super) mod multiply;
pub(super) mod precompute;

use std::path::Path;

use super::light::LightArgs;
use crate::cli::{Problem, view};
use crate::io::{load_matrix_market, write_file, write_matrix_market};
use crate::prt::all_frequency::light::{CubeLight, Decimation};
use crate::prt::bi_scale::matrix::SparseMatrix;
use crate::prt::bi_scale::transfer::light_vector;
use crate::prt::file::{BiScaleFile, load_bi_scale};
use crate::sphere::turn_around_z;

/// A Matrix Market file, or a `.prt` file of bi-scale transfer, by the ending of its name.
fn load(path: &Path) -> miette::Result<BiScaleFile> {
    let is_text = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mtx"));
    // Per byte of a file 1.3 bytes of entries, which are sorted into rows, twice as much.
    view::require_file(path, if is_text { 4 } else { 6 }, "name a smaller matrix")?;
    if !is_text {
        return Ok(load_bi_scale(path)?);
    }
    let matrix = SparseMatrix::from_coordinates(&load_matrix_market(path)?).map_err(|reason| {
        Problem::usage(
            format!("{}: {reason}", path.display()),
            "give values that are whole numbers of some power of two, such as quarters",
        )
    })?;
    Ok(BiScaleFile { meaning: None, matrix: Some(matrix), biclusters: None })
}

/// The light, turned around z by some degrees, and its red, green and blue times solid angles, for a verb.
fn light_channels(light: &LightArgs, degrees: f64, verb: &str) -> miette::Result<(CubeLight, [Vec<f64>; 3])> {
    let cube = light.distant()?.cube(&turn_around_z(degrees / 360.0), Decimation::SolidAngle);
    let cube = cube.map_err(|error| Problem::usage(error.to_string(), format!("see `crossbar prt {verb} --help`")))?;
    let channel =
        |channel: usize| light_vector(&cube.texels().iter().map(|texel| texel[channel]).collect::<Vec<f64>>());
    let channels = [channel(0), channel(1), channel(2)];
    Ok((cube, channels))
}

/// Writes a matrix as text.
fn write_matrix(matrix: &SparseMatrix, comment: &str, path: &Path) -> Result<(), Problem> {
    let size = [matrix.rows(), matrix.columns(), matrix.nonzeros()];
    let value = |value: i32| matrix.unit() * f64::from(value);
    write_file(path, |out| {
        let entries = (0..matrix.rows())
            .flat_map(|row| matrix.row(row).iter().map(move |entry| (row, entry.index as usize, value(entry.value))));
        write_matrix_market(size, comment, entries, out)
    })
    .map_err(Problem::from)
}
