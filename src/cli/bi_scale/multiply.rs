//! `crossbar bi-scale multiply`: product of light and bi-scale transfer.

use std::path::{Path, PathBuf};

use serde_json::json;

use super::file::{cube_of, load};
use crate::bi_scale::file::BiScaleFile;
use crate::bi_scale::matrix::SparseMatrix;
use crate::cli::Problem;
use crate::cli::study::written;
use crate::cli::transfer::light::{CUBE_LIGHT, DEFAULT_LIGHT, DistantLightArg};
use crate::cli::words::counted;
use crate::io::write_file;
use crate::report::{Cell, Findings, Table};
use crate::study::prt::LocalLight;
use crate::transfer::grid::LIGHT_TEXELS;
use crate::transfer::light::CubeLight;

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale multiply docs/examples/step_biclusters.npz --light sky:1,-1,1 --csv local.csv
      light that reaches each local direction of each vertex, by biclusters (Algorithm 2)
  crossbar bi-scale multiply docs/examples/step_biclusters.npz --light red-and-blue --json
      another light; the figures as JSON

A matrix is multiplied row by row in double precision, biclusters in single precision, which rounds values \
that it does not hold.";

/// Multiply light with transfer: the light that reaches each local direction of each vertex
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A matrix of 6,144 columns (.mtx or .npz), or its biclusters (.npz)
    #[arg(value_name = "FILE")]
    file: PathBuf,

    #[arg(long, value_name = "LIGHT", default_value = DEFAULT_LIGHT, allow_hyphen_values = true, help = CUBE_LIGHT)]
    light: DistantLightArg,

    /// Write red, green and blue of every row to this table
    #[arg(long, value_name = "Y.csv")]
    csv: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let file = load(&args.file)?;
    let cube = cube_of(&args.light, "multiply")?;
    let product = multiply(&args.file, &file, &cube)?;
    if let Some(path) = &args.csv {
        let local = file.meaning.map(|meaning| meaning.side.pow(2) as usize);
        write_values(&product.rows, local, path)?;
    }
    let sums = [0, 1, 2].map(|channel| product.rows.iter().map(|row| row[channel]).sum::<f64>());
    let mut table = Table::new("Light that arrives", &["figure", "red", "green", "blue"]);
    let mean = sums.map(|sum| Cell::measured(sum / product.rows.len().max(1) as f64));
    table.push(std::iter::once("mean of a row".into()).chain(mean).collect::<Vec<Cell>>());
    let mut found = Findings::new("Light that arrives");
    found.fields(json!({
        "rows": product.rows.len(), "way": product.way, "flux": cube.flux(), "sum": sums, "seconds": product.seconds,
    }));
    let (rows, seconds) = (counted(product.rows.len()), product.seconds);
    found.introduce(format!("{} times {}, {rows} rows, in {seconds:.3} s", args.light.name(), product.way));
    found.table(table);
    written(&mut found, [("csv", args.csv.as_deref())]);
    Ok(found)
}

/// Computes L~. Fails if the matrix is not transfer.
fn multiply(path: &Path, file: &BiScaleFile, light: &CubeLight) -> Result<LocalLight, Problem> {
    let of_matrix = file.matrix.as_ref().map(SparseMatrix::columns);
    let columns = file.biclusters.as_ref().map(|biclusters| biclusters.matrix_size()[1]).or(of_matrix);
    if let Some(found) = columns.filter(|&columns| columns != LIGHT_TEXELS) {
        let what = format!("{}: expected a matrix of {LIGHT_TEXELS} columns, found {found}", path.display());
        return Err(Problem::usage(what, "name transfer that `crossbar bi-scale precompute` wrote"));
    }
    let product = LocalLight::new(file, light).ok_or_else(|| Problem::usage("no matrix", "name another file"))?;
    if !product.rows.as_flattened().iter().all(|value| value.is_finite()) {
        let what = format!("{}: values or sums beyond the range of the product's precision", path.display());
        return Err(Problem::usage(what, "scale the matrix"));
    }
    Ok(product)
}

/// Writes one line per row, with the vertex and its local direction if known.
fn write_values(local: &[[f64; 3]], directions: Option<usize>, path: &Path) -> Result<(), Problem> {
    write_file(path, |out| {
        writeln!(out, "{},r,g,b", if directions.is_some() { "vertex,direction" } else { "row" })?;
        for (row, [r, g, b]) in local.iter().enumerate() {
            match directions {
                Some(count) => writeln!(out, "{},{},{r},{g},{b}", row / count, row % count)?,
                None => writeln!(out, "{row},{r},{g},{b}")?,
            }
        }
        Ok(())
    })
    .map_err(Problem::from)
}
