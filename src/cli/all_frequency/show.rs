//! `crossbar all-frequency show`: what is in a `.npz` file of transfer for all frequencies.

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::all_frequency::Reflectance;
use crate::all_frequency::code::CodedSegment;
use crate::all_frequency::file::{AllFrequencyFile, load_all_frequency};
use crate::cli::transfer::model::chosen_vertex;
use crate::cli::words::{counted, measured};
use crate::report::{Cell, Findings, Table};

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency show docs/examples/step_all_small.npz
      what is coded, in how many bytes
  crossbar all-frequency show docs/examples/step_all_small.npz --vertex 12
      of one vertex: its cluster and weights in each segment
  crossbar all-frequency show docs/examples/step_all.npz --vertex 12 --json
      what the vertex sees, for machines

The file itself is an archive of NumPy's arrays: docs/npz.md says which.";

/// Show what a .npz file holds: visibility, coded segments, the code of a vertex
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The file
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    /// A vertex, counted from 0
    #[arg(long, value_name = "N")]
    vertex: Option<u32>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let file = &load_all_frequency(&args.file, None)?;
    let vertex = chosen_vertex("all-frequency", args.vertex, file.mesh.vertices as usize)?;
    let mut found = Findings::new("All-frequency transfer");
    found.fields(header(file));
    found.field("vertex", json!(vertex.map(|vertex| vertex_document(file, vertex))));
    match vertex {
        None => all(file, &mut found),
        Some(vertex) => one(file, vertex, &mut found),
    }
    Ok(found)
}

fn header(file: &AllFrequencyFile) -> Value {
    let visible = file.visibility.as_ref().map(|maps| maps.counts.visible);
    let coded = file.coded.as_ref().map(|coded| {
        let (nonzeros, numbers) = coded.nonzeros();
        json!({ "segments": coded.segments.len(), "clusters": coded.clusters(), "nonzeros": nonzeros,
                "numbers": numbers, "bytes": coded.size().total(),
                "representative_bits": coded.options.representative_bits, "weight_bits": coded.options.weight_bits })
    });
    json!({
        "kind": "all-frequency", "mesh": file.mesh.to_string(), "vertices": file.mesh.vertices,
        "terms": file.reflectance.terms(), "hats": file.hats.to_string(), "directions_visible": visible, "coded": coded,
    })
}

fn all(file: &AllFrequencyFile, found: &mut Findings) {
    let terms = file.reflectance.terms();
    found.introduce("kind      all-frequency transfer".to_owned());
    found.introduce(format!("mesh      {}", file.mesh));
    let reflectance = match &file.reflectance {
        Reflectance::Diffuse => "diffuse, one exact term".to_owned(),
        Reflectance::Factored(factors) => {
            let [view, light] = [factors.view_map().side(), factors.light_map().side()];
            format!("{terms} terms on maps of {view} x {view} and {light} x {light} texels")
        }
    };
    found.introduce(format!("factors   {reflectance}; hats of {}", file.hats));
    if let Some(maps) = &file.visibility {
        let per_vertex = maps.counts.visible as f64 / maps.len().max(1) as f64;
        found.introduce(format!("sees      {per_vertex:.0} of 98,304 directions on average"));
    }
    if let Some(coded) = &file.coded {
        let (nonzeros, all) = coded.nonzeros();
        found.introduce(format!(
            "coded     {} clusters in {} segments; {} of {} numbers are not 0; {} bits, weights {}; {} bytes",
            counted(coded.clusters()),
            coded.segments.len(),
            counted(nonzeros),
            counted(all),
            coded.options.representative_bits,
            coded.options.weight_bits,
            counted(coded.size().total() as usize)
        ));
    }
}

/// A segment's code at a vertex.
struct CodedVertex {
    segment: usize,
    cluster: u16,
    weights: Vec<f64>,
    /// The root of the sum of the squares of its decoded transfer.
    norm: f64,
}

impl CodedVertex {
    fn new(part: &CodedSegment, vertex: usize) -> Option<Self> {
        let at = part.vertices.binary_search(&(vertex as u32)).ok()?;
        let transfer = part.decoded(at);
        Some(Self {
            segment: part.segment,
            cluster: part.cluster_of[at],
            weights: part.decoded_weights().nth(at)?,
            norm: transfer.iter().map(|value| value * value).sum::<f64>().sqrt(),
        })
    }
}

/// The segments that a vertex has, in their order.
fn coded_vertex(file: &AllFrequencyFile, vertex: usize) -> Option<Vec<CodedVertex>> {
    let coded = file.coded.as_ref()?;
    Some(coded.segments.iter().filter_map(|part| CodedVertex::new(part, vertex)).collect())
}

/// Directions that a vertex sees.
fn visible(file: &AllFrequencyFile, vertex: usize) -> Option<u32> {
    let maps = file.visibility.as_ref()?;
    Some(maps.bits(vertex).iter().map(|word| word.count_ones()).sum())
}

fn vertex_document(file: &AllFrequencyFile, vertex: usize) -> Value {
    let segment = |part: CodedVertex| json!({ "segment": part.segment, "cluster": part.cluster, "weights": part.weights, "norm": part.norm });
    let coded = coded_vertex(file, vertex).map(|parts| parts.into_iter().map(segment).collect::<Vec<_>>());
    json!({ "number": vertex, "directions_visible": visible(file, vertex), "segments": coded })
}

fn one(file: &AllFrequencyFile, vertex: usize, found: &mut Findings) {
    found.introduce(format!("vertex    {vertex}"));
    if let Some(visible) = visible(file, vertex) {
        found.introduce(format!("sees      {} of 98,304 directions", counted(visible as usize)));
    }
    let Some(parts) = coded_vertex(file, vertex) else { return };
    found.introduce(format!("segments  {} of 24 hold transfer", parts.len()));
    let mut table = Table::new("Code", &["segment", "cluster", "norm", "weights"]);
    for part in parts {
        let weights: Vec<String> = part.weights.iter().map(|weight| measured(*weight)).collect();
        table.push([
            part.segment.into(),
            u64::from(part.cluster).into(),
            Cell::measured(part.norm),
            weights.join(" ").into(),
        ]);
    }
    found.table(table);
}
