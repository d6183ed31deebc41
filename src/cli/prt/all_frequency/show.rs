//! `crossbar prt show` of all-frequency transfer.

use std::path::Path;

use serde_json::json;

use crate::cli::words::counted;
use crate::cli::{Out, view};
use crate::prt::all_frequency::Reflectance;
use crate::prt::all_frequency::visibility::VisibilityMaps;
use crate::prt::file::load_all_frequency;

pub(in crate::cli::prt) fn run(path: &Path, out: &mut Out) -> miette::Result<()> {
    view::require_file(path, 3, "name a smaller file")?;
    let file = load_all_frequency(path, None)?;
    let terms = file.reflectance.terms();
    let visible = file.visibility.as_ref().map(|maps| maps.counts.visible);
    if out.json() {
        let coded = file.coded.as_ref().map(|coded| {
            let (nonzeros, numbers) = coded.nonzeros();
            json!({ "segments": coded.segments.len(), "clusters": coded.clusters(), "nonzeros": nonzeros,
                    "numbers": numbers, "bytes": coded.size().total(),
                    "representative_bits": coded.options.representative_bits, "weight_bits": coded.options.weight_bits })
        });
        return Ok(out.document(&json!({
            "kind": "all-frequency", "mesh": file.mesh.to_string(), "vertices": file.mesh.vertices, "terms": terms,
            "hats": file.hats.to_string(), "directions_visible": visible, "coded": coded,
        }))?);
    }
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
