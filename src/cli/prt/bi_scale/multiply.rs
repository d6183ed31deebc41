//! `crossbar prt multiply`: light times bi-scale transfer.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde_json::json;

use super::{light_channels, load};
use crate::cli::prt::light::LightArgs;
use crate::cli::words::counted;
use crate::cli::{Out, Problem};
use crate::io::write_file;
use crate::prt::all_frequency::grid::LIGHT_TEXELS;
use crate::prt::bi_scale::product::{self, Gather};
use crate::prt::file::BiScaleFile;
use crate::report::{Cell, Table};

const EXAMPLES: &str = "\
Examples:
  crossbar prt multiply docs/examples/step_biclusters.prt --light sky:1,-1,1 --values local.csv
      light that reaches each local direction of each vertex, by biclusters (Algorithm 2)
  crossbar prt multiply docs/examples/step_biclusters.prt --light red-and-blue --rotate 90 --json
      another light, turned; figures for machines

Of a matrix the product is taken row by row, in double precision.";

/// Multiply light with transfer: the light that reaches each local direction of each vertex
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(in crate::cli::prt) struct Args {
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

pub(in crate::cli::prt) fn run(args: &Args, out: &mut Out) -> miette::Result<()> {
    let file = load(&args.file)?;
    let (cube, channels) = light_channels(&args.light, args.rotate, "multiply")?;
    let product = Product::new(&args.file, &file, &channels)?;
    if let Some(path) = &args.values {
        let local = file.meaning.map(|meaning| meaning.side.pow(2) as usize);
        write_values(&product.local, local, path)?;
    }
    let sums = [0, 1, 2].map(|channel| product.local.iter().map(|row| row[channel]).sum::<f64>());
    if out.json() {
        return Ok(out.document(&json!({
            "rows": product.local.len(), "way": product.way, "flux": cube.flux(), "sum": sums,
            "seconds": product.seconds, "values": args.values,
        }))?);
    }
    let mut table = Table::new("Light that arrives", &["figure", "red", "green", "blue"]);
    let mean = sums.map(|sum| Cell::measured(sum / product.local.len().max(1) as f64));
    table.push(std::iter::once("mean of a row".into()).chain(mean).collect::<Vec<Cell>>());
    out.sentence(format_args!(
        "{} times {}, {} rows, in {:.3} s",
        args.light.name(),
        product.way,
        counted(product.local.len()),
        product.seconds
    ))?;
    out.table(&table)?;
    if let Some(path) = &args.values {
        out.line(format_args!("written   {}", path.display()))?;
    }
    Ok(())
}

struct Product {
    way: &'static str,
    local: Vec<[f64; 3]>,
    /// Of the multiplication alone.
    seconds: f64,
}

impl Product {
    /// By biclusters in f32 where there are any, else by rows in f64.
    fn new(path: &Path, file: &BiScaleFile, channels: &[Vec<f64>; 3]) -> Result<Self, Problem> {
        let columns = |found: usize| {
            if found == LIGHT_TEXELS {
                return Ok(());
            }
            let what = format!("{}: expected a matrix of {LIGHT_TEXELS} columns, found {found}", path.display());
            Err(Problem::usage(what, "name transfer that `crossbar prt precompute --kind bi-scale` wrote"))
        };
        if let Some(biclusters) = &file.biclusters {
            columns(biclusters.matrix_size()[1])?;
            let gather = Gather::new(biclusters);
            let light: Vec<[f32; 3]> =
                (0..LIGHT_TEXELS).map(|texel| [0, 1, 2].map(|channel| channels[channel][texel] as f32)).collect();
            let start = Instant::now();
            let local = gather.multiply(&light);
            let seconds = start.elapsed().as_secs_f64();
            let local = local.into_iter().map(|row| row.map(f64::from)).collect();
            return Ok(Self { way: "biclusters", local, seconds });
        }
        let matrix = file.matrix.as_ref().ok_or_else(|| Problem::usage("no matrix", "name another file"))?;
        columns(matrix.columns())?;
        let start = Instant::now();
        let [red, green, blue] = [0, 1, 2].map(|channel: usize| product::by_rows(matrix, &channels[channel]));
        let seconds = start.elapsed().as_secs_f64();
        let local = red.into_iter().zip(green).zip(blue).map(|((red, green), blue)| [red, green, blue]).collect();
        Ok(Self { way: "rows", local, seconds })
    }
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
