//! `crossbar all-frequency compress`: transfer by segments, clustered and coded.

use std::path::PathBuf;

use miette::IntoDiagnostic;
use serde_json::json;

use super::precompute::path_from;
use crate::all_frequency::code::{CodeOptions, CodedTransfer};
use crate::all_frequency::compressed::SegmentOptions;
use crate::all_frequency::file::{AllFrequencyFile, load_all_frequency, save_all_frequency};
use crate::cli::study::written;
use crate::cli::transfer::model::model_of;
use crate::cli::words::counted;
use crate::cli::{CommandLine, Problem, ProgressBar, version};
use crate::clustering::CpcaMethod;
use crate::kept::{KeptResults, KeptWork, SpentTime};
use crate::options::number;
use crate::report::{Cell, Findings, Table};
use crate::study::prt::{SegmentTally, SegmentedCompression};
use crate::transfer::linear_basis::LinearBasis;
use crate::transfer::visibility::SegmentCensus;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency compress docs/examples/step_all.npz --model docs/examples/step.obj --points-per-cluster 40 --vectors 4 --out small.npz
      compressed segment by segment in linear clusters (without means), with 16 bits per coded number
  crossbar all-frequency compress docs/examples/step_all.npz --model docs/examples/step.obj --points-per-cluster 40 --vectors 2 --bits 8 --json --out small.npz
      with fewer bits per coded number; the error of every segment as JSON

The whole transfer is never stored: each segment is computed, compressed and coded before the next.";

/// Compress transfer segment by segment, and code it
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A .npz file with visibility, as `crossbar all-frequency precompute` writes it
    #[arg(value_name = "X.npz")]
    signal: PathBuf,

    /// The model from which the file was made
    #[arg(long, value_name = "MODEL")]
    model: PathBuf,

    /// Vertices per cluster on average
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = number::whole::<u32>(1..=u32::MAX))]
    points_per_cluster: u32,

    /// Representatives per cluster; at most as many as a vertex has numbers in a segment, which is 256 times the number
    /// of terms of the reflectance
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = number::whole::<u32>(1..=u32::MAX))]
    vectors: u32,

    /// Bits of each number of a representative, and of each weight
    #[arg(long, value_name = "BITS", default_value_t = 16, value_parser = number::whole::<u8>(2..=16))]
    bits: u8,

    /// Store finished segments in this folder, and reuse the segments that it already holds; the folder of a different
    /// run is refused
    #[arg(long, value_name = "FOLDER")]
    resume: Option<PathBuf>,

    /// The file to write
    #[arg(long, value_name = "Y.npz")]
    out: PathBuf,
}

pub(super) fn run(args: &Args, command_line: &CommandLine) -> miette::Result<Findings> {
    let file = load_all_frequency(&args.signal, None)?;
    let (_, vertices, _) = model_of(&args.signal, Some(file.mesh), &args.model, None)?;
    let Some(maps) = &file.visibility else {
        let what = format!("{}: expected visibility, found coded transfer only", args.signal.display());
        return Err(Problem::usage(what, "give a file that `crossbar all-frequency precompute` wrote").into());
    };
    let most = 256 * file.reflectance.terms() as u64;
    if u64::from(args.vectors) > most {
        let what = format!("expected at most {most} `--vectors`, found {}", args.vectors);
        let help = "a vertex has only that many numbers in a segment, so more vectors do not reduce the error";
        return Err(Problem::usage(what, help).into());
    }
    let options = SegmentOptions {
        points_per_cluster: args.points_per_cluster as usize,
        vectors: args.vectors as usize,
        method: CpcaMethod::Doubling,
        ..SegmentOptions::default()
    };
    let code = CodeOptions { representative_bits: args.bits, weight_bits: args.bits, ..CodeOptions::default() };
    let kept = |folder: &PathBuf| {
        let work = KeptWork::new(&version::program()?, command_line.text.clone(), &[&args.signal, &args.model])?;
        let kept = KeptResults::new(folder.clone(), work, SpentTime::default);
        kept.require_no_other_work().map(|()| kept)
    };
    let kept = args.resume.as_ref().map(kept).transpose()?;
    let compression = SegmentedCompression {
        vertices: &vertices,
        maps,
        hats: file.hats,
        reflectance: &file.reflectance,
        options,
        code,
        kept: kept.as_ref().map(|kept| (kept, "")),
    };
    let bar = ProgressBar::new("", 1).quicker("more `--points-per-cluster`");
    let (coded, tally) = compression.run(&mut |what, done, of| bar.show(what.to_owned(), done, of))?;
    drop(bar);
    let census = SegmentCensus::new(&vertices, maps, &LinearBasis::new(file.hats));
    let raw = compression.raw_bytes();
    let model = file.model.as_ref().map(|_| path_from(&args.out, &args.model)).transpose().into_diagnostic()?;
    let found = findings(args, (&coded, kept.as_ref().map_or(0, KeptResults::taken)), &tally, &census, raw);
    let small = AllFrequencyFile { visibility: None, coded: Some(coded), model, ..file };
    save_all_frequency(&small, &args.out).map_err(Problem::from)?;
    Ok(found)
}

fn findings(
    args: &Args,
    (coded, taken): (&CodedTransfer, usize),
    tallies: &[SegmentTally],
    census: &SegmentCensus,
    raw: u64,
) -> Findings {
    let mut found = Findings::new("Transfer by segments");
    found.table(segments(tallies));
    let segment = |part: &SegmentTally| {
        json!({
            "segment": part.segment, "vertices": part.vertices, "clusters": part.clusters, "squares": part.squares,
            "squared_error": part.squared_error, "coded_squared_error": part.coded_squared_error,
        })
    };
    let ((nonzeros, all), size) = (coded.nonzeros(), coded.size());
    let weights: usize = coded.segments.iter().map(|part| part.weights.len()).sum();
    // Weights and representatives in single precision.
    let clustered = 4 * (all + weights) as u64;
    let blocks: usize = coded.segments.iter().map(|part| part.representatives.block_count()).sum();
    // The sum of no numbers is -0, which would be printed.
    let sum = |of: &dyn Fn(&SegmentTally) -> f64| 0.0 + tallies.iter().map(of).sum::<f64>();
    let squares = sum(&|part| part.squares);
    let share = |error: f64| if error > 0.0 { error / squares } else { 0.0 };
    let after = share(sum(&|part| part.coded_squared_error));
    let before = share(sum(&|part| part.squared_error));
    let [transfer, clusters, code] = [0, 1, 2].map(|step| sum(&|part| part.seconds[step]));
    found.fields(json!({
        "vertices": coded.vertices, "terms": coded.rows, "omega": census.omega(),
        "segments_below_horizon": { "least": census.least_below, "mean": census.mean_below() },
        "clusters": coded.clusters(), "segments_kept": taken,
        "bytes": { "raw": raw, "clustered": clustered, "coded": size.total(),
                   "as_the_paper_counts": size.as_the_paper_counts() },
        "code": { "blocks": blocks, "columns": coded.rows * coded.coefficients, "nonzeros": nonzeros, "numbers": all,
                  "bytes": { "representatives": size.representatives, "columns": size.columns,
                             "weights": size.weights, "steps": size.steps, "clusters": size.clusters } },
        "squared_error": after, "squared_error_before_coding": before,
        "seconds": { "transfer": transfer, "clusters": clusters, "code": code },
        "segments": tallies.iter().map(segment).collect::<Vec<_>>(),
    }));
    let percent = |part: f64, whole: f64| 100.0 * part / whole;
    found.print(format!("segments  {:.1} % of all segments have nonzero transfer", 100.0 * census.omega()));
    found.print(format!("clusters  {}", counted(coded.clusters())));
    for (what, bytes) in [("raw", raw), ("clustered", clustered), ("coded", size.total())] {
        found.print(format!("{what:9} {} bytes, {:.2} %", counted(bytes as usize), percent(bytes as f64, raw as f64)));
    }
    let dense = percent(nonzeros as f64, all.max(1) as f64);
    found.print(format!("nonzeros  {} of {}: {dense:.1} %", counted(nonzeros), counted(all)));
    found.print(format!(
        "error     {:.4} % of the sum of squares; {:.4} % before coding",
        100.0 * after,
        100.0 * before
    ));
    found.print(format!("time      transfer {transfer:.1} s, clusters {clusters:.1} s, coding {code:.1} s"));
    if let Some(folder) = &args.resume {
        found.print(format!("kept      {taken} segments were already finished in {}", folder.display()));
    }
    written(&mut found, [("out", Some(args.out.as_path()))]);
    found
}

fn segments(segments: &[SegmentTally]) -> Table {
    let row = |part: &SegmentTally| {
        let [error, coded] = [part.squared_error, part.coded_squared_error]
            .map(|error| (part.squares > 0.0).then(|| Cell::measured(100.0 * error / part.squares)));
        [part.segment.into(), part.vertices.into(), part.clusters.into(), Cell::from(error), coded.into()]
    };
    let headings = ["segment", "vertices", "clusters", "squared error (%)", "coded (%)"];
    Table::new("Segments", &headings).with(segments.iter().map(row))
}
