//! `crossbar bi-scale bicluster`: a sparse matrix as a sum of constant-column biclusters.

use std::path::PathBuf;
use std::time::Instant;

use serde_json::json;

use super::file::{histogram, load, unit, value_counts, values_document};
use crate::bi_scale::bicluster::{Biclustering, SEED, bicluster};
use crate::bi_scale::file::{BiScaleFile, save_bi_scale};
use crate::bi_scale::matrix::SparseMatrix;
use crate::cli::study::written;
use crate::cli::{Problem, ProgressBar};
use crate::error::InputError;
use crate::report::{Cell, Findings, Table};

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale bicluster docs/examples/quarters.mtx
      any sparse matrix: how many operations and bytes its product with a vector takes as biclusters
  crossbar bi-scale bicluster docs/examples/quarters.mtx --out biclusters.npz
      writes the biclusters to a file that `crossbar bi-scale show` reads
  crossbar bi-scale bicluster docs/examples/quarters.mtx --json
      the figures as JSON

The values must be integer multiples of a single power of two (2^-30 or larger); these integers must fit into 32 bits. \
The sum of the biclusters equals the matrix bit for bit.";

/// Split any sparse matrix into biclusters, without loss: its product with a vector takes fewer operations and bytes
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// A Matrix Market file (.mtx), or a file that `crossbar bi-scale precompute` wrote
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Write the biclusters to a .npz file
    #[arg(long, value_name = "X.npz")]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let name = args.file.display();
    let file = load(&args.file)?;
    let matrix = file.matrix.as_ref().ok_or_else(|| {
        let what = format!("{name}: expected a matrix, found biclusters only");
        Problem::usage(what, "give the file from which the biclusters were made")
    })?;
    let start = Instant::now();
    let biclusters =
        made(matrix).map_err(|error| Problem::usage(format!("{name}: {error}"), "use a smaller matrix"))?;
    let seconds = start.elapsed().as_secs_f64();
    let values = value_counts(&file);
    let (rows, columns, nonzeros) = (matrix.rows(), matrix.columns(), matrix.nonzeros());
    let (before, after) = (2 * nonzeros as u64, biclusters.cost());
    let [dense_1, dense_4, rows_3, rows_8, of_biclusters] = bytes(matrix, &biclusters);
    let figures = [
        ("rows", Some(rows.into())),
        ("columns", Some(columns.into())),
        ("values other than 0", Some(nonzeros.into())),
        ("values are", Some(unit(matrix.fraction_bits()).into())),
        ("biclusters", Some(biclusters.len().into())),
        ("rows of the biclusters", Some(biclusters.row_entries().into())),
        ("columns of the biclusters", Some(biclusters.column_entries().into())),
        ("operations per product, matrix", Some(before.into())),
        ("operations per product, biclusters", Some(after.into())),
        ("share of operations (%)", (before > 0).then(|| Cell::measured(100.0 * after as f64 / before as f64))),
        ("bytes, dense, 1 byte per value", Some(dense_1.into())),
        ("bytes, dense, floats", Some(dense_4.into())),
        ("bytes, by rows, 3 bytes per value", Some(rows_3.into())),
        ("bytes, by rows, 8 bytes per value", Some(rows_8.into())),
        ("bytes, biclusters", Some(of_biclusters.into())),
        ("seconds", Some(Cell::measured(seconds))),
    ];
    let figures = figures.into_iter().filter_map(|(what, value)| Some([what.into(), value?]));
    let mut found = Findings::new("Biclusters");
    found.table(Table::new("Biclusters", &["figure", "value"]).with(figures));
    found.table(histogram(&values));
    found.fields(json!({
        "rows": rows, "columns": columns, "nonzeros": nonzeros, "values": values_document(&values),
        "flops_before": before, "flops_after": after, "biclusters": biclusters.len(),
        "row_entries": biclusters.row_entries(), "column_entries": biclusters.column_entries(),
        "bytes": { "dense_1": dense_1, "dense_4": dense_4, "rows_3": rows_3, "rows_8": rows_8,
                   "biclusters": of_biclusters },
        "unit_bits": matrix.fraction_bits(), "seconds": seconds,
    }));
    if let Some(path) = &args.out {
        let file = BiScaleFile { meaning: file.meaning, matrix: None, biclusters: Some(biclusters) };
        save_bi_scale(&file, path).map_err(Problem::from)?;
    }
    written(&mut found, [("out", args.out.as_deref())]);
    Ok(found)
}

/// Computes the biclusters of a matrix, and shows its progress by entries.
fn made(matrix: &SparseMatrix) -> Result<Biclustering, InputError> {
    let total = matrix.nonzeros() as u64;
    let bar = ProgressBar::new("non-zeros", total);
    let mut number = 0_u64;
    let mut found = |left: u64| {
        number += 1;
        if number.is_multiple_of(64) {
            bar.show("non-zeros".to_owned(), total.saturating_sub(left), total);
        }
    };
    bicluster(matrix, SEED, &mut found)
}

/// Bytes by layout: dense as bytes and as floats; compressed rows with columns and values of 2 and 1 bytes, and of 4
/// and 4; biclusters with 4 bytes per row and 4 + 4 per column, as in the paper.
fn bytes(matrix: &SparseMatrix, biclusters: &Biclustering) -> [u64; 5] {
    let [rows, columns, nonzeros] = [matrix.rows(), matrix.columns(), matrix.nonzeros()].map(|count| count as u64);
    let begins = 4 * (rows + 1);
    let entries = biclusters.row_entries() as u64 + 2 * biclusters.column_entries() as u64;
    [rows * columns, 4 * rows * columns, 3 * nonzeros + begins, 8 * nonzeros + begins, 4 * entries]
}
