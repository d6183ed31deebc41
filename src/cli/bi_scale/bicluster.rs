//! `crossbar bi-scale bicluster`: a sparse matrix as a sum of constant-column biclusters.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
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
      writes them to a file that `crossbar bi-scale show` reads
  crossbar bi-scale bicluster docs/examples/quarters.mtx --json
      the figures as JSON

The values must be multiples of one power of two, at least 2^-30, that 32 bits hold. The sum of the biclusters equals \
the matrix bit for bit.";

/// Make biclusters of any sparse matrix, without loss: fewer operations for its product with a vector, fewer bytes
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// A Matrix Market file (.mtx), or what `crossbar bi-scale precompute` wrote
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Write the biclusters to a .npz file
    #[arg(long, value_name = "X.npz")]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let BiScaleFile { meaning, matrix, .. } = load(&args.file)?;
    let matrix = matrix.ok_or_else(|| {
        let what = format!("{}: expected a matrix, found biclusters only", args.file.display());
        Problem::usage(what, "name the file that they were made from")
    })?;
    let start = Instant::now();
    let biclusters = made(&matrix).map_err(|error| refused(&args.file, &error))?;
    let seconds = start.elapsed().as_secs_f64();
    let summary = Summary { matrix: &matrix, biclusters: &biclusters, seconds };
    let mut found = summary.findings();
    if let Some(path) = &args.out {
        let file = BiScaleFile { meaning, matrix: None, biclusters: Some(biclusters) };
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

fn refused(path: &Path, error: &dyn std::error::Error) -> Problem {
    Problem::usage(format!("{}: {error}", path.display()), "name a smaller matrix")
}

struct Summary<'a> {
    matrix: &'a SparseMatrix,
    biclusters: &'a Biclustering,
    seconds: f64,
}

impl Summary<'_> {
    fn flops_before(&self) -> u64 {
        2 * self.matrix.nonzeros() as u64
    }

    /// Bytes by layout: dense as bytes and as floats; compressed rows with columns and values of 2 and 1 bytes, and of
    /// 4 and 4; biclusters with 4 bytes per row and 4 + 4 per column, as in the paper.
    fn bytes(&self) -> [(&'static str, &'static str, u64); 5] {
        let (rows, columns) = (self.matrix.rows() as u64, self.matrix.columns() as u64);
        let nonzeros = self.matrix.nonzeros() as u64;
        let begins = 4 * (rows + 1);
        let entries = self.biclusters.row_entries() as u64 + 2 * self.biclusters.column_entries() as u64;
        [
            ("dense_1", "dense, a byte each", rows * columns),
            ("dense_4", "dense, floats", 4 * rows * columns),
            ("rows_3", "by rows, 3 bytes each", 3 * nonzeros + begins),
            ("rows_8", "by rows, 8 bytes each", 8 * nonzeros + begins),
            ("biclusters", "biclusters", 4 * entries),
        ]
    }

    fn findings(&self) -> Findings {
        let values = value_counts(self.matrix);
        let bytes: BTreeMap<&str, u64> = self.bytes().into_iter().map(|(key, _, bytes)| (key, bytes)).collect();
        let mut found = Findings::new("Biclusters");
        found.table(self.table());
        found.table(histogram(&values));
        found.fields(json!({
            "rows": self.matrix.rows(), "columns": self.matrix.columns(), "nonzeros": self.matrix.nonzeros(),
            "values": values_document(&values), "flops_before": self.flops_before(), "flops_after": self.biclusters.cost(),
            "biclusters": self.biclusters.len(), "row_entries": self.biclusters.row_entries(),
            "column_entries": self.biclusters.column_entries(), "bytes": bytes,
            "unit_bits": self.matrix.fraction_bits(), "seconds": self.seconds,
        }));
        found
    }

    fn table(&self) -> Table {
        let (before, after) = (self.flops_before(), self.biclusters.cost());
        let mut table = Table::new("Biclusters", &["figure", "value"]);
        table.push(["rows".into(), self.matrix.rows().into()]);
        table.push(["columns".into(), self.matrix.columns().into()]);
        table.push(["values other than 0".into(), self.matrix.nonzeros().into()]);
        table.push(["values are".into(), unit(self.matrix.fraction_bits()).into()]);
        table.push(["biclusters".into(), self.biclusters.len().into()]);
        table.push(["their rows".into(), self.biclusters.row_entries().into()]);
        table.push(["their columns".into(), self.biclusters.column_entries().into()]);
        table.push(["operations per product, matrix".into(), before.into()]);
        table.push(["operations per product, biclusters".into(), after.into()]);
        if before > 0 {
            table.push(["share (%)".into(), Cell::measured(100.0 * after as f64 / before as f64)]);
        }
        for (_, what, bytes) in self.bytes() {
            table.push([format!("bytes, {what}").into(), bytes.into()]);
        }
        table.push(["seconds".into(), Cell::measured(self.seconds)]);
        table
    }
}
