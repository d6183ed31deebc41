//! `crossbar bi-scale multiply`: light times bi-scale transfer.

use std::path::{Path, PathBuf};

use serde_json::json;

use super::file::{load, turned};
use crate::bi_scale::file::BiScaleFile;
use crate::bi_scale::matrix::SparseMatrix;
use crate::cli::transfer::light::LightArgs;
use crate::cli::words::counted;
use crate::cli::{Out, Problem};
use crate::io::write_file;
use crate::report::{Cell, Table};
use crate::study::prt::LocalLight;
use crate::transfer::grid::LIGHT_TEXELS;
use crate::transfer::light::CubeLight;

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale multiply docs/examples/step_biclusters.prt --light sky:1,-1,1 --values local.csv
      light that reaches each local direction of each vertex, by biclusters (Algorithm 2)
  crossbar bi-scale multiply docs/examples/step_biclusters.prt --light red-and-blue --rotate 90 --json
      another light, turned; figures for machines

Of a matrix the product is taken row by row, in double precision.";

/// Multiply light with transfer: the light that reaches each local direction of each vertex
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A matrix of 6,144 columns (.mtx or .prt), or its biclusters (.prt)
    #[arg(value_name = "FILE")]
    file: PathBuf,

    #[command(flatten)]
    light: LightArgs,

    /// Turn the light around z, in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, value_parser = crate::cli::number::finite,
          allow_hyphen_values = true)]
    rotate: f64,

    /// Write red, green and blue of every row to this table
    #[arg(long, value_name = "Y.csv")]
    values: Option<PathBuf>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<()> {
    let file = load(&args.file)?;
    let cube = turned(&args.light, args.rotate, "multiply")?;
    let product = multiply(&args.file, &file, &cube)?;
    if let Some(path) = &args.values {
        let local = file.meaning.map(|meaning| meaning.side.pow(2) as usize);
        write_values(&product.rows, local, path)?;
    }
    let sums = [0, 1, 2].map(|channel| product.rows.iter().map(|row| row[channel]).sum::<f64>());
    if out.json() {
        return Ok(out.document(&json!({
            "rows": product.rows.len(), "way": product.way, "flux": cube.flux(), "sum": sums,
            "seconds": product.seconds, "values": args.values,
        }))?);
    }
    let mut table = Table::new("Light that arrives", &["figure", "red", "green", "blue"]);
    let mean = sums.map(|sum| Cell::measured(sum / product.rows.len().max(1) as f64));
    table.push(std::iter::once("mean of a row".into()).chain(mean).collect::<Vec<Cell>>());
    out.sentence(format_args!(
        "{} times {}, {} rows, in {:.3} s",
        args.light.name(),
        product.way,
        counted(product.rows.len()),
        product.seconds
    ))?;
    out.table(&table)?;
    if let Some(path) = &args.values {
        out.line(format_args!("written   {}", path.display()))?;
    }
    Ok(())
}

/// L~, unless the matrix is none of transfer.
fn multiply(path: &Path, file: &BiScaleFile, light: &CubeLight) -> Result<LocalLight, Problem> {
    let of_matrix = file.matrix.as_ref().map(SparseMatrix::columns);
    let columns = file.biclusters.as_ref().map(|biclusters| biclusters.matrix_size()[1]).or(of_matrix);
    if let Some(found) = columns.filter(|&columns| columns != LIGHT_TEXELS) {
        let what = format!("{}: expected a matrix of {LIGHT_TEXELS} columns, found {found}", path.display());
        return Err(Problem::usage(what, "name transfer that `crossbar bi-scale precompute` wrote"));
    }
    LocalLight::new(file, light).ok_or_else(|| Problem::usage("no matrix", "name another file"))
}

/// A line per row; with the vertex and its local direction where these are known.
fn write_values(local: &[[f64; 3]], directions: Option<usize>, path: &Path) -> Result<(), Problem> {
    write_file(path, |out| {
        writeln!(out, "{}", if directions.is_some() { "vertex,direction,r,g,b" } else { "row,r,g,b" })?;
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
