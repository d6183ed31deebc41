//! `crossbar cpca error`: a compressed signal beside the original.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde_json::json;

use super::file::{clusters, model_of};
use crate::cli::Problem;
use crate::cli::study::written;
use crate::cli::transfer::vertex_names::VertexNames;
use crate::cli::words::{counted, measured};
use crate::io::write_file;
use crate::report::Findings;
use crate::study::prt::CompressionError;
use crate::transfer::clustering::Clustering;
use crate::transfer::{Signal, load_signal_and_meaning};

const EXAMPLES: &str = "\
Examples:
  crossbar cpca error docs/examples/step.npz docs/examples/step_small.npz
      squared error of all vertices, the largest, and how many have how much
  crossbar cpca error docs/examples/step.npz docs/examples/step_small.npz --csv errors.csv --json
      and a line per vertex: its cluster, its squared error, its squares
  crossbar cpca error docs/examples/step.npz docs/examples/step_small.npz --model docs/examples/step.obj --csv errors.csv
      with the number of each vertex in the model's file, and its place";

/// Compare a compressed signal with the original: error of each point, largest, histogram
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// The original: a .npz file with transfer, a CSV table or an array of NumPy's
    #[arg(value_name = "SIGNAL")]
    signal: PathBuf,

    /// Its compressed form
    #[arg(value_name = "Y.npz")]
    compressed: PathBuf,

    /// The model that the transfer was made from: points are named by its vertices, too
    #[arg(long, value_name = "MODEL")]
    model: Option<PathBuf>,

    /// Write a line per point to this file
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let (meaning, mesh, signal) = load_signal_and_meaning(&args.signal)?;
    let (file, clustering) = clusters(&args.compressed)?;
    let shapes = [(signal.points(), signal.dimension()), (clustering.points(), clustering.dimension())];
    if shapes[0] != shapes[1] {
        let [one, other] = shapes.map(|(points, numbers)| format!("{points} points of {numbers} numbers"));
        return Err(other_signal(&args.compressed, &one, &other).into());
    }
    if let (Some(one), Some(other)) = (mesh, file.mesh)
        && one != other
    {
        return Err(other_signal(&args.compressed, &format!("a mesh with {one}"), &other.to_string()).into());
    }
    if mesh.is_some() && meaning != file.meaning {
        return Err(other_signal(&args.compressed, "numbers of the same meaning", "others").into());
    }
    let of_model = args.model.as_ref().map(|model| model_of(&args.signal, mesh, model)).transpose()?;
    let named = args.model.as_ref().zip(of_model.as_ref());
    let names = named.map(|(model, (_, vertices, _))| VertexNames::new(model, vertices));
    let error = CompressionError::new(&signal, &clustering);
    if let Some(path) = &args.csv {
        write_csv(path, &signal, &clustering, &error, names.as_ref())?;
    }
    let largest = error.largest();
    let cluster = clustering.of_point()[largest];
    let mut found = Findings::new("Error of compression");
    found.fields(json!({
        "points": signal.points(),
        "numbers_per_point": signal.dimension(),
        "squared_error": error.total,
        "squared_signal": error.energy,
        "relative_error": error.relative(),
        "root_mean_square": error.root_mean_square(),
        "largest": { "point": largest, "cluster": cluster, "squared_error": error.squared[largest],
                     "of_model": names.as_ref().map(|names| names.document(largest)) },
        "histogram": error.histogram().json(),
    }));
    let [points, numbers] = [signal.points(), signal.dimension()].map(counted);
    found.introduce(format!("points         {points} of {numbers} numbers"));
    let [squared, relative] = [error.total, error.relative()].map(measured);
    found.introduce(format!("squared error  {squared}, {relative} of the signal's squares"));
    found.introduce(format!("root mean sq.  {} over all numbers", measured(error.root_mean_square())));
    let name = names.as_ref().map_or_else(String::new, |names| format!(" ({})", names.phrase(largest)));
    let squared = measured(error.squared[largest]);
    found.introduce(format!("largest        {squared} at point {largest}{name}, of cluster {cluster}"));
    found.table(error.histogram());
    written(&mut found, [("csv", args.csv.as_deref())]);
    Ok(found)
}

fn other_signal(path: &Path, expected: &str, found: &str) -> Problem {
    let help = "name the signal that it was compressed from, or compress it again";
    Problem::usage(format!("{}: expected {expected}, found {found}", path.display()), help)
}

/// A line per point, shortest digits that read back to the same numbers.
fn write_csv(
    path: &Path,
    signal: &Signal,
    clustering: &Clustering,
    error: &CompressionError,
    names: Option<&VertexNames<'_>>,
) -> Result<(), Problem> {
    let square = |&value: &f32| f64::from(value) * f64::from(value);
    write_file(path, |file| {
        let mut file = std::io::BufWriter::new(file);
        let columns = names.map_or_else(String::new, |_| format!(",{}", VertexNames::COLUMNS));
        writeln!(file, "point,cluster,squared_error,squares{columns}")?;
        for (point, (cluster, squared)) in clustering.of_point().iter().zip(&error.squared).enumerate() {
            let squares: f64 = signal.point(point).iter().map(square).sum();
            let name = names.map_or_else(String::new, |names| format!(",{}", names.fields(point)));
            writeln!(file, "{point},{cluster},{squared:e},{squares:e}{name}")?;
        }
        file.flush()
    })?;
    Ok(())
}
