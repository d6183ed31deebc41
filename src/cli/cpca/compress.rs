//! `crossbar cpca compress`: clustered principal components of any signal.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::cli::transfer::values::MethodArg;
use crate::cli::words::{counted, measured};
use crate::cli::{Out, Problem, ProgressBar, memory, view};
use crate::io::{ReadError, read_limited};
use crate::report::{Cell, Table};
use crate::study::prt::CompressionError;
use crate::transfer::clustering::{
    Clustering, Compression, CpcaError, CpcaForm, CpcaOptions, CpcaStep, CpcaStepKind, StartPoints, compress,
};
use crate::transfer::file::{PrtFile, save_prt};
use crate::transfer::{Signal, load_signal_and_meaning};

const EXAMPLES: &str = "\
Examples:
  crossbar cpca compress docs/examples/step.prt --clusters 8 --vectors 3 --out small.prt
      each vertex as the mean of its cluster and three weighted vectors
  crossbar cpca compress docs/examples/step.prt --clusters 4 --vectors 2 --method adaptive --iterations 20 --json --out small.prt
      vectors redistributed among the clusters; every step's error for machines
  crossbar cpca compress docs/examples/signal.csv --clusters 3 --vectors 1 --start docs/examples/start.txt --out small.prt
      a signal of one's own, a line of numbers per point, from given start points

CSV and NumPy arrays hold a row per point. The file that is written holds the clusters alone.";

/// Compress transfer, or any signal, by clustered principal components
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A .prt file with transfer, a CSV table or an array of NumPy's (.npy)
    #[arg(value_name = "SIGNAL")]
    signal: PathBuf,

    /// Clusters
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..))]
    clusters: u32,

    /// Vectors per cluster; 0 is vector quantisation [default: 8, or as many as a point has numbers]
    #[arg(long, value_name = "N")]
    vectors: Option<u32>,

    /// By which measure points are shared out to clusters
    #[arg(long, value_enum, value_name = "HOW", default_value = "iterative")]
    method: MethodArg,

    /// Without the clusters' means: vectors alone, the components of the points themselves
    #[arg(long)]
    linear: bool,

    /// Iterations at most for each number of vectors, and rounds of redistribution
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    iterations: u32,

    /// Draws the start points
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,

    /// The start points instead: a file with the number of a point per line, counted from 0, one per cluster
    #[arg(long, value_name = "FILE", conflicts_with = "seed")]
    start: Option<PathBuf>,

    /// The file to write
    #[arg(long, value_name = "Y.prt")]
    out: PathBuf,
}

/// How to ask for less memory.
const HELP: &str = "name a smaller signal";
/// Bytes of a point beside its numbers and weights.
const POINT_BYTES: u64 = 64;

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<()> {
    // The bytes, and numbers of four bytes while their list grows: a number takes two bytes of a table at least.
    view::require_file(&args.signal, 8, HELP)?;
    let start = start(args)?;
    let (meaning, mesh, signal) = load_signal_and_meaning(&args.signal)?;
    let most = u32::try_from(signal.dimension().min(signal.points())).unwrap_or(u32::MAX);
    let (clusters, vectors) = (args.clusters, args.vectors.unwrap_or(most.min(8)));
    if vectors > most {
        let what =
            format!("expected at most {most} `--vectors`, the lesser of points and their numbers, found {vectors}");
        return Err(Problem::usage(what, "more vectors than that approximate nothing better").into());
    }
    let need = memory_need(&signal, u64::from(clusters), u64::from(vectors));
    let size = format_args!("compressing {} points", counted(signal.points())).to_string();
    memory::require(size, need, HELP)?;
    let iterations = args.iterations as usize;
    let options = CpcaOptions {
        clusters: clusters as usize,
        vectors: vectors as usize,
        iterations,
        method: args.method.method(iterations),
        form: if args.linear { CpcaForm::Linear } else { CpcaForm::Affine },
        start,
    };
    let bar = ProgressBar::new("vectors", u64::from(vectors) + 1);
    let observe = |step: &CpcaStep| bar.show("vectors".to_owned(), step.vectors as u64, u64::from(vectors) + 1);
    let Compression { clustering, steps } = compress(&signal, &options, observe).map_err(|error| refused(&error))?;
    drop(bar);
    let error = CompressionError::new(&signal, &clustering);
    let file = PrtFile { meaning, mesh, transfer: None, clustering: Some(clustering) };
    save_prt(&file, &args.out).map_err(Problem::from)?;
    let stored = file.clustering.as_ref().map_or(0, Clustering::stored_numbers);
    if out.json() {
        return Ok(out.document(&document(args, &signal, &steps, &error, stored))?);
    }
    out.table(&table(&steps, error.energy))?;
    out.line("")?;
    let numbers = signal.values().len();
    out.line(format_args!("signal    {} points of {} numbers", counted(signal.points()), counted(signal.dimension())))?;
    let share = 100.0 * stored as f64 / numbers as f64;
    out.line(format_args!("stored    {} numbers in place of {}: {share:.1} %", counted(stored), counted(numbers)))?;
    out.line(format_args!("error     {} of the signal's squares", measured(error.relative())))?;
    out.line(format_args!("written   {}", args.out.display()))?;
    Ok(())
}

/// Bytes while a signal is compressed: its numbers, and in f64 those of a cluster, which may be all; per point
/// its weights, where they begin, its cluster, its error and bounds of that; per cluster its vectors, the last and the
/// next ones.
fn memory_need(signal: &Signal, clusters: u64, vectors: u64) -> u64 {
    let [values, points, dimension] = [signal.values().len(), signal.points(), signal.dimension()].map(|n| n as u64);
    let of_points = points.saturating_mul(8 * vectors + POINT_BYTES);
    let of_clusters = clusters.min(points).saturating_mul(vectors + 1).saturating_mul(24 * dimension);
    (12 * values).saturating_add(of_points).saturating_add(of_clusters)
}

/// The start points of a file, else those of the seed.
fn start(args: &Args) -> miette::Result<StartPoints> {
    /// Longest list of start points, in bytes.
    const LIMIT: u64 = 64 << 20;
    let Some(path) = &args.start else { return Ok(StartPoints::Seed(args.seed)) };
    let what = "list of start points";
    let read = read_limited(path, LIMIT).map_err(|source| ReadError::Unreadable { what, path: path.into(), source })?;
    let bytes = read.ok_or_else(|| ReadError::TooLong { what, path: path.into(), limit: LIMIT })?;
    Ok(StartPoints::parse(&String::from_utf8_lossy(&bytes)).map_err(|error| in_file(path, &error))?)
}

fn in_file(path: &Path, error: &CpcaError) -> Problem {
    Problem::usage(format!("{}: {error}", path.display()), "give the number of a point per line, counted from 0")
}

fn refused(error: &CpcaError) -> Problem {
    let help = match error {
        CpcaError::Clusters { .. } => "choose fewer `--clusters`, or name a larger signal",
        CpcaError::NothingLinear => "choose more `--vectors`, or leave `--linear` out",
        CpcaError::Vectors { .. } => "choose fewer `--vectors`",
        CpcaError::StartCount { .. } => "give as many start points as `--clusters`",
        _ => "see `crossbar cpca compress --help`",
    };
    Problem::usage(error.to_string(), help)
}

const fn word(kind: CpcaStepKind) -> &'static str {
    match kind {
        CpcaStepKind::Classified => "classified",
        CpcaStepKind::Fitted => "fitted",
        CpcaStepKind::Redistributed => "redistributed",
    }
}

/// What each number of vectors ended with, and every redistribution; all steps stand in the document.
fn table(steps: &[CpcaStep], energy: f64) -> Table {
    let mut table = Table::new("Steps", &["steps", "vectors", "ends", "squared error", "of the signal (%)"]);
    let last = |at: usize| steps.get(at + 1).is_none_or(|next| next.vectors != steps[at].vectors);
    for (at, step) in steps.iter().enumerate() {
        if last(at) || step.kind == CpcaStepKind::Redistributed {
            let share = if energy > 0.0 { Cell::measured(100.0 * step.squared_error / energy) } else { Cell::Empty };
            let error = Cell::measured(step.squared_error);
            table.push([(at + 1).into(), step.vectors.into(), word(step.kind).into(), error, share]);
        }
    }
    table
}

fn document(args: &Args, signal: &Signal, steps: &[CpcaStep], error: &CompressionError, stored: usize) -> Value {
    let step = |step: &CpcaStep| {
        let &CpcaStep { vectors, kind, moved, squared_error } = step;
        json!({ "vectors": vectors, "step": word(kind), "moved": moved, "squared_error": squared_error })
    };
    json!({
        "out": args.out,
        "points": signal.points(),
        "numbers_per_point": signal.dimension(),
        "stored_numbers": stored,
        "squared_error": error.total,
        "squared_signal": error.energy,
        "relative_error": error.relative(),
        "steps": steps.iter().map(step).collect::<Vec<_>>(),
    })
}
