//! `crossbar cpca error`: compares a compressed signal with the original.

use std::path::{Path, PathBuf};

use serde_json::json;

use super::file::clusters;
use crate::cli::Problem;
use crate::cli::words::{counted, measured};
use crate::report::Findings;
use crate::study::prt::CompressionError;
use crate::transfer::load_signal;

const EXAMPLES: &str = "\
Examples:
  crossbar cpca error docs/examples/step.npz docs/examples/step_small.npz
      squared error of all vertices, the largest, and a histogram
  crossbar cpca error docs/examples/step.npz docs/examples/step_small.npz --json
      the same as JSON";

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
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let (meaning, mesh, signal) = load_signal(&args.signal)?;
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
    let error = CompressionError::new(&signal, &clustering);
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
        "largest": { "point": largest, "cluster": cluster, "squared_error": error.squared[largest] },
        "histogram": error.histogram().json(),
    }));
    let [points, numbers] = [signal.points(), signal.dimension()].map(counted);
    found.introduce(format!("points         {points} of {numbers} numbers"));
    let [squared, relative] = [error.total, error.relative()].map(measured);
    found.introduce(format!("squared error  {squared}, {relative} of the signal's squares"));
    found.introduce(format!("root mean sq.  {} over all numbers", measured(error.root_mean_square())));
    let squared = measured(error.squared[largest]);
    found.introduce(format!("largest        {squared} at point {largest}, of cluster {cluster}"));
    found.table(error.histogram());
    Ok(found)
}

fn other_signal(path: &Path, expected: &str, found: &str) -> Problem {
    let help = "name the signal that it was compressed from, or compress it again";
    Problem::usage(format!("{}: expected {expected}, found {found}", path.display()), help)
}
