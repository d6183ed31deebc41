//! `crossbar all-frequency show`: what is in a `.prt` file of transfer for all frequencies.

use std::path::PathBuf;

use serde_json::{Value, json};

use super::arrays;
use super::file::FileOfModel;
use crate::all_frequency::Reflectance;
use crate::all_frequency::code::CodedSegment;
use crate::all_frequency::file::{AllFrequencyFile, load_all_frequency};
use crate::cli::transfer::model::nearest;
use crate::cli::transfer::vertex_names::VertexNames;
use crate::cli::words::{counted, measured};
use crate::cli::{Out, Problem, number, view};
use crate::report::{Cell, Table};
use crate::transfer::visibility::VisibilityMaps;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency show docs/examples/step_all_small.prt
      what is coded, in how many bytes
  crossbar all-frequency show docs/examples/step_all_small.prt --vertex 12 --arrays arrays
      and of one vertex: its cluster and weights in each segment; all of it as arrays of NumPy's
  crossbar all-frequency show docs/examples/step_all.prt --at 0.5,0,0 --model docs/examples/step.obj --json
      the vertex nearest to a place of its model, for machines

`crossbar all-frequency render --values csv` writes the radiance of all vertices under a light.";

/// Show what a .prt file holds: visibility, coded segments, the code of a vertex
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The file
    #[arg(value_name = "FILE.prt")]
    file: PathBuf,

    /// A vertex, counted from 0
    #[arg(long, value_name = "N", group = "which")]
    vertex: Option<u32>,

    /// The vertex nearest to this place of the model
    #[arg(long, value_name = "X,Y,Z", value_parser = number::point, requires = "model", group = "which",
          allow_hyphen_values = true)]
    at: Option<[f32; 3]>,

    /// The model that the file was made from: it says where the vertex is, and its number in the model's file
    #[arg(long, value_name = "MODEL", requires = "which")]
    model: Option<PathBuf>,

    /// Write what the file holds to this folder as arrays of NumPy's: factors, each segment's representatives, weights
    /// and clusters, and what the vertex sees and its transfer
    #[arg(long, value_name = "DIR")]
    arrays: Option<PathBuf>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<()> {
    view::require_file(&args.file, 3, "name a smaller file")?;
    let (file, of_model) = match &args.model {
        Some(model) => {
            let FileOfModel { file, vertices, .. } = FileOfModel::load(&args.file, model)?;
            (file, Some(vertices))
        }
        None => (load_all_frequency(&args.file, None)?, None),
    };
    let (file, folder) = (&file, args.arrays.as_deref());
    let nearest = || nearest(of_model.as_ref()?.positions(), args.at?);
    let vertex = args.vertex.map(|vertex| vertex as usize).or_else(nearest);
    let vertices = file.mesh.vertices as usize;
    if let Some(vertex) = vertex.filter(|&vertex| vertex >= vertices) {
        let what = format!("expected a vertex below {vertices} (counted from 0), found {vertex}");
        return Err(Problem::usage(what, "`crossbar all-frequency show` says how many there are").into());
    }
    let names = args.model.as_ref().zip(of_model.as_ref());
    let names = names.map(|(model, vertices)| VertexNames::new(model, vertices));
    let written = folder.map(|folder| arrays::write(file, vertex, folder)).transpose()?;
    if out.json() {
        let mut document = header(file);
        document["vertex"] = json!(vertex.map(|vertex| vertex_document(file, vertex, names.as_ref())));
        document["arrays"] = json!(written);
        return Ok(out.document(&document)?);
    }
    match vertex {
        None => all(file, out)?,
        Some(vertex) => one(file, vertex, names.as_ref(), out)?,
    }
    if let (Some(written), Some(folder)) = (written, folder) {
        out.line(format_args!("written   {} arrays in {}", written.len(), folder.display()))?;
    }
    Ok(())
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

fn all(file: &AllFrequencyFile, out: &mut Out) -> miette::Result<()> {
    let terms = file.reflectance.terms();
    out.line("kind      all-frequency transfer")?;
    out.sentence(format_args!("mesh      {}", file.mesh))?;
    let reflectance = match &file.reflectance {
        Reflectance::Diffuse => "diffuse, one exact term".to_owned(),
        Reflectance::Factored(factors) => {
            format!(
                "{terms} terms on maps of {0} x {0} and {1} x {1} texels",
                factors.view_map().side(),
                factors.light_map().side()
            )
        }
    };
    out.sentence(format_args!("factors   {reflectance}; hats of {}", file.hats))?;
    if let Some(maps) = &file.visibility {
        let VisibilityMaps { counts, .. } = maps;
        let per_vertex = counts.visible as f64 / maps.len().max(1) as f64;
        out.sentence(format_args!("sees      {per_vertex:.0} of 98,304 directions on average"))?;
    }
    if let Some(coded) = &file.coded {
        let (nonzeros, all) = coded.nonzeros();
        let bits = [coded.options.representative_bits, coded.options.weight_bits];
        out.sentence(format_args!(
            "coded     {} clusters in {} segments; {} of {} numbers are not 0; {} bits, weights {}; {} bytes",
            counted(coded.clusters()),
            coded.segments.len(),
            counted(nonzeros),
            counted(all),
            bits[0],
            bits[1],
            counted(coded.size().total() as usize)
        ))?;
    }
    Ok(())
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

fn vertex_document(file: &AllFrequencyFile, vertex: usize, names: Option<&VertexNames<'_>>) -> Value {
    let segment = |part: CodedVertex| json!({ "segment": part.segment, "cluster": part.cluster, "weights": part.weights, "norm": part.norm });
    let coded = coded_vertex(file, vertex).map(|parts| parts.into_iter().map(segment).collect::<Vec<_>>());
    let of_model = names.map(|names| names.document(vertex));
    json!({ "number": vertex, "of_model": of_model, "directions_visible": visible(file, vertex), "segments": coded })
}

fn one(file: &AllFrequencyFile, vertex: usize, names: Option<&VertexNames<'_>>, out: &mut Out) -> miette::Result<()> {
    out.line(format_args!("vertex    {vertex}"))?;
    if let Some(names) = names {
        out.line(format_args!("is        {}", names.phrase(vertex)))?;
    }
    if let Some(visible) = visible(file, vertex) {
        out.line(format_args!("sees      {} of 98,304 directions", counted(visible as usize)))?;
    }
    let Some(parts) = coded_vertex(file, vertex) else { return Ok(()) };
    out.line(format_args!("segments  {} of 24 hold transfer", parts.len()))?;
    out.line("")?;
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
    out.titled_table(&table)?;
    Ok(())
}
