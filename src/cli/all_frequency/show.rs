//! `crossbar all-frequency show`: contents of a `.npz` file of transfer for all frequencies.

use std::path::PathBuf;

use serde_json::json;

use crate::all_frequency::Reflectance;
use crate::all_frequency::code::CodeOptions;
use crate::all_frequency::file::load_all_frequency;
use crate::cli::words::counted;
use crate::report::Findings;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency show docs/examples/step_all_small.npz
      the coded parts, and their sizes in bytes
  crossbar all-frequency show docs/examples/step_all.npz --json
      which directions the vertices see, as JSON

The file is an archive of NumPy arrays: docs/npz.md lists them.";

/// Show the contents of a .npz file: visibility, coded segments
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The file
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let file = load_all_frequency(&args.file, None)?;
    let terms = file.reflectance.terms();
    let mut found = Findings::new("All-frequency transfer");
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
    file.model.iter().for_each(|model| found.introduce(format!("model     {model}")));
    let visible = file.visibility.as_ref().map(|maps| maps.counts.visible);
    if let Some(maps) = &file.visibility {
        let per_vertex = maps.counts.visible as f64 / maps.len().max(1) as f64;
        found.introduce(format!("visible   {per_vertex:.0} of 98,304 directions per vertex on average"));
    }
    let coded = file.coded.as_ref().map(|coded| {
        let (nonzeros, numbers) = coded.nonzeros();
        let (segments, clusters, bytes) = (coded.segments.len(), coded.clusters(), coded.size().total());
        let CodeOptions { representative_bits, weight_bits, .. } = coded.options;
        found.introduce(format!(
            "coded     {} clusters in {segments} segments; {} of {} numbers are not 0; {representative_bits} bits per \
             number, {weight_bits} per weight; {} bytes",
            counted(clusters),
            counted(nonzeros),
            counted(numbers),
            counted(bytes as usize)
        ));
        json!({ "segments": segments, "clusters": clusters, "nonzeros": nonzeros, "numbers": numbers, "bytes": bytes,
                "representative_bits": representative_bits, "weight_bits": weight_bits })
    });
    found.fields(json!({
        "kind": "all-frequency", "mesh": file.mesh.to_string(), "vertices": file.mesh.vertices, "terms": terms,
        "model": file.model, "hats": file.hats.to_string(), "directions_visible": visible, "coded": coded,
    }));
    Ok(found)
}
