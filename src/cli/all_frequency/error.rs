//! `crossbar all-frequency error`: the coded transfer, compared with recomputed raw matrices.

use std::path::PathBuf;

use serde_json::json;

use super::file::FileOfModel;
use crate::all_frequency::file::load_all_frequency;
use crate::cli::transfer::model::refused;
use crate::cli::words::{counted, measured};
use crate::cli::{Problem, ProgressBar};
use crate::report::Findings;
use crate::study::prt::coded_errors;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency error docs/examples/step_all.npz docs/examples/step_all_small.npz --model docs/examples/step.obj
      squared error of all vertices, and the largest
  crossbar all-frequency error docs/examples/step_all.npz docs/examples/step_all_small.npz --model docs/examples/step.obj --json
      the same as JSON";

/// Compare coded transfer with the original, which is computed again: error of each vertex, and the largest
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// The original: a .npz file with visibility
    #[arg(value_name = "X.npz")]
    signal: PathBuf,

    /// Its compressed form
    #[arg(value_name = "Y.npz")]
    compressed: PathBuf,

    /// The model of both
    #[arg(long, value_name = "MODEL")]
    model: PathBuf,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let FileOfModel { file, vertices, digest, .. } = FileOfModel::load(&args.signal, &args.model)?;
    let other = load_all_frequency(&args.compressed, Some(&digest))?;
    let (Some(maps), Some(coded)) = (&file.visibility, &other.coded) else {
        let what = "expected a file with visibility, then one with coded transfer, found others";
        return Err(
            Problem::usage(what, "name files that `crossbar all-frequency precompute` and `compress` wrote").into()
        );
    };
    if (&file.reflectance, file.hats) != (&other.reflectance, other.hats) {
        let what =
            format!("{}: expected coded transfer of the same reflectance, found other", args.compressed.display());
        return Err(Problem::usage(what, "name the file that it was compressed from").into());
    }
    let bar = ProgressBar::new("", 1);
    let progress = &mut |what: &str, done, of| bar.show(what.to_owned(), done, of);
    let errors = coded_errors((&vertices, maps), file.hats, &file.reflectance, coded, progress).map_err(refused)?;
    drop(bar);
    let squared: f64 = errors.squared_errors.iter().sum();
    let squares: f64 = errors.squares.iter().sum();
    let largest =
        (0..errors.squared_errors.len()).max_by(|&a, &b| errors.squared_errors[a].total_cmp(&errors.squared_errors[b]));
    let largest = largest.unwrap_or(0);
    let mut found = Findings::new("Error of coded transfer");
    found.fields(json!({
        "vertices": vertices.len(), "squared_error": squared, "squared_transfer": squares,
        "relative_error": squared / squares,
        "largest": { "vertex": largest, "squared_error": errors.squared_errors[largest] },
    }));
    found.introduce(format!("vertices       {}", counted(vertices.len())));
    let [error, relative] = [squared, squared / squares].map(measured);
    found.introduce(format!("squared error  {error}, {relative} of the transfer's squares"));
    let squared = measured(errors.squared_errors[largest]);
    found.introduce(format!("largest        {squared} at vertex {largest}"));
    Ok(found)
}
