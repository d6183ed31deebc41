//! `crossbar bi-scale show`: contents of a matrix or its biclusters.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::file::{histogram, load, unit, value_counts, values_document};
use crate::bi_scale::bicluster::Biclustering;
use crate::bi_scale::file::BiScaleFile;
use crate::bi_scale::matrix::SparseMatrix;
use crate::cli::Problem;
use crate::cli::study::written;
use crate::cli::words::counted;
use crate::error::InputError;
use crate::io::{write_file, write_matrix_market};
use crate::report::{Cell, Findings, Table};

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale show docs/examples/court_biclusters.npz
      the values, and the biclusters by size
  crossbar bi-scale show docs/examples/quarters.mtx --json
      any sparse matrix, as JSON
  crossbar bi-scale show docs/examples/step_biclusters.npz --matrix step.mtx
      the matrix that the biclusters sum to";

/// Show the contents of a matrix or of a .npz file of biclusters: values, sizes of biclusters
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A Matrix Market file (.mtx), or a file that `crossbar bi-scale precompute` or `bicluster` wrote
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Write the matrix (or the sum of the biclusters, which is the same) to this Matrix Market file
    #[arg(long, value_name = "X.mtx")]
    matrix: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let file = load(&args.file)?;
    let of_biclusters = || file.biclusters.as_ref().map_or(0, |biclusters| biclusters.matrix_size()[0]);
    let rows = file.matrix.as_ref().map_or_else(of_biclusters, SparseMatrix::rows);
    let local = file.meaning.map_or(1, |meaning| meaning.side.pow(2) as usize);
    if let Some(path) = &args.matrix {
        write_text(&file, &args.file, path)?;
    }
    let mut found = Findings::new("Bi-scale transfer");
    if let Some(meaning) = file.meaning {
        let vertices = counted(rows / local);
        found.introduce(format!("transfer  bi-scale, {vertices} vertices, {local} local directions each"));
        found.introduce(format!("horizon   {}", meaning.horizon));
        found.introduce(format!("mesh      {}", meaning.mesh));
    } else {
        found.introduce(format!("matrix    {} rows", counted(rows)));
    }
    let parts = [file.matrix.is_some().then_some("matrix"), file.biclusters.is_some().then_some("biclusters")];
    found.introduce(format!("holds     {}", parts.into_iter().flatten().collect::<Vec<_>>().join(" and ")));
    if let Some(bits) = file.fraction_bits() {
        found.introduce(format!("values    {}", unit(bits)));
    }
    let values = value_counts(&file);
    found.table(histogram(&values));
    if let Some(biclusters) = &file.biclusters {
        let headings = ["rows up to", "biclusters", "their rows", "their columns", "operations"];
        let sizes = sizes(biclusters).into_iter().map(|size| size.map(Cell::from));
        found.table(Table::new("Biclusters", &headings).with(sizes));
    }
    found.fields(document(&file, rows, local, &values));
    written(&mut found, [("matrix", args.matrix.as_deref())]);
    Ok(found)
}

fn write_text(file: &BiScaleFile, name: &Path, path: &Path) -> Result<(), Problem> {
    let sum = file.biclusters.as_ref().filter(|_| file.matrix.is_none()).map(Biclustering::sum);
    let refused = |error: InputError| Problem::usage(format!("{}: {error}", name.display()), "give another file");
    let sum = sum.transpose().map_err(refused)?;
    let matrix = file.matrix.as_ref().or(sum.as_ref()).expect("a matrix or biclusters");
    let size = [matrix.rows(), matrix.columns(), matrix.nonzeros()];
    let entries = (0..matrix.rows()).flat_map(|row| {
        matrix.row(row).iter().map(move |entry| (row, entry.index as usize, matrix.value(entry.value)))
    });
    let comment = format!("of {}, by crossbar bi-scale show", name.display());
    write_file(path, |out| write_matrix_market(size, &comment, entries, out)).map_err(Problem::from)
}

/// Biclusters by number of rows (up to 1, 3, 7, 15 and so on), with their total rows and columns, and their cost.
fn sizes(biclusters: &Biclustering) -> Vec<[u64; 5]> {
    let mut sizes: BTreeMap<u32, [u64; 5]> = BTreeMap::new();
    for number in 0..biclusters.len() {
        let [rows, columns] = [biclusters.rows_of(number).len(), biclusters.columns_of(number).len()];
        let class = (rows as u64 + 1).ilog2() + u32::from(!(rows as u64 + 1).is_power_of_two());
        let into = sizes.entry(class).or_insert([(1_u64 << class) - 1, 0, 0, 0, 0]);
        for (into, more) in into[1..].iter_mut().zip([1, rows, columns, rows + 2 * columns - 1]) {
            *into += more as u64;
        }
    }
    sizes.into_values().collect()
}

fn document(file: &BiScaleFile, rows: usize, local: usize, values: &[(f64, u64)]) -> Value {
    let mesh = file.meaning.map(|meaning| {
        json!({ "vertices": meaning.mesh.vertices, "triangles": meaning.mesh.triangles,
                "tangents": meaning.mesh.tangents.to_string(), "horizon": meaning.horizon.to_string(),
                "local_directions": local })
    });
    let biclusters = file.biclusters.as_ref().map(|biclusters| {
        let size = |[most, count, rows, columns, operations]: [u64; 5]| {
            json!({ "rows_up_to": most, "biclusters": count, "rows": rows, "columns": columns,
                    "operations": operations })
        };
        let sizes: Vec<Value> = sizes(biclusters).into_iter().map(size).collect();
        json!({ "count": biclusters.len(), "operations": biclusters.cost(), "sizes": sizes })
    });
    json!({ "rows": rows, "mesh": mesh, "unit_bits": file.fraction_bits(),
            "nonzeros": file.matrix.as_ref().map(SparseMatrix::nonzeros), "values": values_document(values),
            "biclusters": biclusters })
}
