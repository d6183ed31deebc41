//! `crossbar prt compress` of all-frequency transfer.

use std::fs;
use std::path::Path;

use serde_json::json;

use super::FileOfModel;
use crate::all_frequency::code::{CodeOptions, CodedTransfer, ScaleOf};
use crate::all_frequency::compressed::SegmentOptions;
use crate::all_frequency::file::{AllFrequencyFile, save_all_frequency};
use crate::cli::prt::compress::{Args, MethodArg};
use crate::cli::prt::segments::{ScaleArg, SegmentArgs};
use crate::cli::words::counted;
use crate::cli::{Out, Problem, ProgressBar, memory, view};
use crate::io::ReadError;
use crate::report::{Cell, Table};
use crate::study::prt::{CompressionTally, KeptSegments, SegmentTally, SegmentedCompression};
use crate::transfer::file::MeshDigest;
use crate::transfer::hats::Hats;
use crate::transfer::visibility::SegmentCensus;

pub(in crate::cli::prt) fn run(args: &Args, out: &mut Out) -> miette::Result<()> {
    view::require_file(&args.signal, 3, "name a smaller file")?;
    let Some(model) = &args.segments.model else {
        let what = "transfer of all frequencies is computed from its model segment by segment: `--model` is missing";
        return Err(Problem::usage(what, "name the model that was given to `crossbar prt precompute`").into());
    };
    let FileOfModel { file, vertices, .. } = FileOfModel::load(&args.signal, model)?;
    let Some(maps) = &file.visibility else {
        let what = format!("{}: expected visibility, found coded transfer alone", args.signal.display());
        return Err(Problem::usage(what, "name a file that `crossbar prt precompute` wrote").into());
    };
    let numbers = 4 * 256 * file.reflectance.terms() as u64;
    // A segment of all vertices, its clusters, the vertices along axes, and inner products of clusters' vertices.
    let bytes = maps.len() as u64 * (numbers * 3 / 2 + 6500) + (128 << 20);
    let what = format_args!("a segment of the transfer of {} vertices, {numbers} bytes each", maps.len());
    memory::require(what, bytes, "name a model of fewer vertices, or factors of fewer terms")?;
    let (options, code) = (options(args), code(&args.segments));
    let kept = args.segments.resume.as_ref().map(|folder| kept(folder, (&args.signal, file.mesh), &options, code));
    let compression = SegmentedCompression {
        vertices: &vertices,
        maps,
        hats: file.hats,
        reflectance: &file.reflectance,
        options,
        code,
        kept: kept.transpose()?,
    };
    let bar = ProgressBar::new("", 1);
    let (coded, tally) = compression.run(&mut |what, done, of| bar.show(what.to_owned(), done, of))?;
    drop(bar);
    let census = SegmentCensus::new(&vertices, maps, &Hats::new(file.hats));
    let raw = compression.raw_bytes();
    let written = AllFrequencyFile { visibility: None, coded: Some(coded), ..file };
    save_all_frequency(&written, &args.out).map_err(Problem::from)?;
    let Some(coded) = &written.coded else { return Ok(()) };
    if out.json() {
        return Ok(out.document(&document(args, coded, &tally, &census, raw))?);
    }
    tell(args, coded, &tally, &census, raw, out)
}

fn options(args: &Args) -> SegmentOptions {
    let default = SegmentOptions::default();
    SegmentOptions {
        points_per_cluster: args
            .segments
            .points_per_cluster
            .map_or(default.points_per_cluster, |points| points as usize),
        vectors: args.vectors.map_or(default.vectors, |vectors| vectors as usize),
        iterations: args.iterations as usize,
        method: args.method(MethodArg::Doubling),
        seed: args.seed,
    }
}

/// The folder of finished segments, with everything that their bits depend on.
fn kept(
    folder: &Path,
    (signal, mesh): (&Path, MeshDigest),
    options: &SegmentOptions,
    code: CodeOptions,
) -> miette::Result<KeptSegments> {
    let path = signal.to_owned();
    let bytes = fs::read(signal).map_err(|source| ReadError::Unreadable { what: "transfer", path, source })?;
    Ok(KeptSegments::open(
        folder,
        mesh,
        [
            ("checksum of the transfer", format!("{:08x}", crc32fast::hash(&bytes))),
            ("vertices per cluster", options.points_per_cluster.to_string()),
            ("representatives", options.vectors.to_string()),
            ("iterations", options.iterations.to_string()),
            ("method", format!("{:?}", options.method)),
            ("seed", options.seed.to_string()),
            ("bits of representatives", code.representative_bits.to_string()),
            ("bits of weights", code.weight_bits.to_string()),
            ("steps of one", format!("{:?}", code.scale)),
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ],
    )?)
}

fn code(args: &SegmentArgs) -> CodeOptions {
    CodeOptions {
        representative_bits: args.bits.unwrap_or(16),
        weight_bits: args.weight_bits.unwrap_or(16),
        scale: match args.scale.unwrap_or_default() {
            ScaleArg::Representative => ScaleOf::Representative,
            ScaleArg::Segment => ScaleOf::Segment,
        },
    }
}

/// Bytes of weights and representatives in single precision.
fn clustered_bytes(coded: &CodedTransfer) -> u64 {
    4 * (coded.nonzeros().1 + coded.segments.iter().map(|part| part.weights.len()).sum::<usize>()) as u64
}

fn document(
    args: &Args,
    coded: &CodedTransfer,
    tally: &CompressionTally,
    census: &SegmentCensus,
    raw: u64,
) -> serde_json::Value {
    let squares = tally.sum(|part| part.squares);
    let (nonzeros, all) = coded.nonzeros();
    let size = coded.size();
    let blocks: usize = coded.segments.iter().map(|part| part.representatives.block_count()).sum();
    let segment = |part: &SegmentTally| {
        json!({
            "segment": part.segment, "vertices": part.vertices, "clusters": part.clusters, "squares": part.squares,
            "squared_error": part.squared_error, "coded_squared_error": part.coded_squared_error,
        })
    };
    let seconds = |step: usize| tally.sum(|part| part.seconds[step]);
    json!({
        "out": args.out, "vertices": coded.vertices, "terms": coded.rows, "omega": census.omega(),
        "segments_below_horizon": { "least": census.least_below, "mean": census.mean_below() },
        "clusters": coded.clusters(), "segments_kept": tally.kept,
        "bytes": { "raw": raw, "clustered": clustered_bytes(coded), "coded": size.total(),
                   "as_the_paper_counts": size.as_the_paper_counts() },
        "code": { "blocks": blocks, "columns": coded.rows * coded.coefficients, "nonzeros": nonzeros, "numbers": all,
                  "bytes": { "representatives": size.representatives, "columns": size.columns,
                             "weights": size.weights, "steps": size.steps, "clusters": size.clusters } },
        "squared_error": tally.sum(|part| part.coded_squared_error) / squares,
        "squared_error_before_coding": tally.sum(|part| part.squared_error) / squares,
        "seconds": { "transfer": seconds(0), "clusters": seconds(1), "code": seconds(2) },
        "segments": tally.segments.iter().map(segment).collect::<Vec<_>>(),
    })
}

fn tell(
    args: &Args,
    coded: &CodedTransfer,
    tally: &CompressionTally,
    census: &SegmentCensus,
    raw: u64,
    out: &mut Out,
) -> miette::Result<()> {
    let mut table = Table::new("Segments", &["segment", "vertices", "clusters", "squared error (%)", "coded (%)"]);
    let share =
        |error: f64, squares: f64| if squares > 0.0 { Cell::measured(100.0 * error / squares) } else { Cell::Empty };
    for part in &tally.segments {
        let errors = [part.squared_error, part.coded_squared_error].map(|error| share(error, part.squares));
        let [error, coded] = errors;
        table.push([part.segment.into(), part.vertices.into(), part.clusters.into(), error, coded]);
    }
    out.table(&table)?;
    out.line("")?;
    let (nonzeros, all) = coded.nonzeros();
    let size = coded.size();
    let percent = |bytes: u64| 100.0 * bytes as f64 / raw as f64;
    out.sentence(format_args!("segments  {:.1} % of all hold transfer", 100.0 * census.omega()))?;
    out.line(format_args!("clusters  {}", counted(coded.clusters())))?;
    let clustered = clustered_bytes(coded);
    for (what, bytes) in [("raw", raw), ("clustered", clustered), ("coded", size.total())] {
        out.line(format_args!("{what:9} {} bytes, {:.2} %", counted(bytes as usize), percent(bytes)))?;
    }
    let dense = 100.0 * nonzeros as f64 / all.max(1) as f64;
    out.sentence(format_args!("nonzeros  {} of {}: {dense:.1} %", counted(nonzeros), counted(all)))?;
    let squares = tally.sum(|part| part.squares);
    let errors = [tally.sum(|part| part.coded_squared_error), tally.sum(|part| part.squared_error)];
    let [after, before] = errors.map(|error| 100.0 * error / squares);
    out.sentence(format_args!("error     {after:.4} % of the squares; {before:.4} % before coding"))?;
    let [transfer, clusters, code] = [0, 1, 2].map(|step| tally.sum(|part| part.seconds[step]));
    out.sentence(format_args!(
        "time      {transfer:.1} s of transfer, {clusters:.1} s of clusters, {code:.1} s of code"
    ))?;
    if let Some(folder) = &args.segments.resume {
        out.sentence(format_args!("kept      {} segments were finished before, in {}", tally.kept, folder.display()))?;
    }
    out.line(format_args!("written   {}", args.out.display()))?;
    Ok(())
}
