//! `crossbar all-frequency show`: contents of a `.npz` file of transfer for all frequencies.

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::all_frequency::Reflectance;
use crate::all_frequency::file::{AllFrequencyFile, load_all_frequency};
use crate::cli::words::counted;
use crate::report::Findings;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency show docs/examples/step_all_small.npz
      what is coded, in how many bytes
  crossbar all-frequency show docs/examples/step_all.npz --json
      what the vertices see, as JSON

The file itself is an archive of NumPy's arrays: docs/npz.md says which.";

/// Show the contents of a .npz file: visibility, coded segments
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The file
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let file = &load_all_frequency(&args.file, None)?;
    let mut found = Findings::new("All-frequency transfer");
    found.fields(header(file));
    all(file, &mut found);
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
        "terms": file.reflectance.terms(), "model": file.model, "hats": file.hats.to_string(), "directions_visible": visible, "coded": coded,
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
    file.model.iter().for_each(|model| found.introduce(format!("model     {model}")));
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
