//! `crossbar bi-scale precompute`: the macro-scale transfer of a model's vertices.

use serde_json::json;

use super::file::angle;
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::file::{BiScaleFile, BiScaleMeaning, save_bi_scale};
use crate::bi_scale::transfer::transfer_matrix;
use crate::cli::study::written;
use crate::cli::transfer::model::{ModelArgs, note_rays, note_vertices, refused};
use crate::cli::words::counted;
use crate::cli::{Problem, ProgressBar};
use crate::geom::Sides;
use crate::options::number;
use crate::report::Findings;
use crate::transfer::file::MeshDigest;
use crate::transfer::grid::LIGHT_TEXELS;
use crate::transfer::visibility::{Horizon, VisibilityMaps, VisibilitySampling};

/// Base-2 logarithm of the samples per side of a light texel: 2 x 2 samples give five values of visibility.
const LOG2_SAMPLES: u32 = 1;

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale precompute docs/examples/step.obj --directions 8 --out step.npz
      which light texels each vertex sees, in each of its 64 local directions
  crossbar bi-scale precompute docs/examples/court.obj --directions 4 --crease 40 --out court.npz
      with normals that are smooth across edges of up to 40 degrees";

/// Compute which light texels each vertex of a model sees, by local direction: a sparse matrix
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    #[command(flatten)]
    of: ModelArgs,

    /// Local directions per side of the square that is mapped to the hemisphere
    #[arg(long, value_name = "K", default_value_t = 8, value_parser = number::whole::<u8>(1..=64))]
    directions: u8,

    /// Recompute normals from the triangles, smooth over edges up to this angle in degrees; `crossbar bi-scale render`
    /// needs the same angle [default: use the model's own normals]
    #[arg(long, value_name = "DEGREES", value_parser = angle, allow_hyphen_values = true)]
    crease: Option<f64>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let (side, path) = (args.directions, args.of.out.as_path());
    let directions = LocalDirections::new(side.into())?;
    let (caster, model, vertices) = args.of.load(args.crease)?;
    let sampling = VisibilitySampling { log2_samples: LOG2_SAMPLES, horizon: Horizon::Geometry };
    let bar = ProgressBar::new("visibility", 1).quicker("fewer `--directions`");
    let mut caster = caster.open_judged(&model.mesh, Sides::Both)?;
    let all: Vec<u32> = (0..vertices.len() as u32).collect();
    let mut show = |done: usize, of: usize| bar.show("visibility".to_owned(), done as u64, of as u64);
    let maps = VisibilityMaps::trace_sampled(&vertices, &all, sampling, &mut caster, &mut show).map_err(refused)?;
    let matrix = transfer_matrix(&vertices, &maps, &directions).map_err(|error| {
        Problem::usage(error.to_string(), "give a model with fewer vertices, or choose fewer `--directions`")
    })?;
    let counts = maps.counts.clone();
    drop((bar, maps));
    let meaning = BiScaleMeaning { mesh: MeshDigest::new(&vertices), side: side.into(), horizon: sampling.horizon };
    let (rows, nonzeros) = (matrix.rows(), matrix.nonzeros());
    let file = BiScaleFile { meaning: Some(meaning), matrix: Some(matrix), biclusters: None };
    save_bi_scale(&file, path).map_err(Problem::from)?;
    let mut found = Findings::new("Bi-scale transfer");
    found.fields(json!({
        "vertices": vertices.len(), "rows": rows, "columns": LIGHT_TEXELS, "nonzeros": nonzeros,
    }));
    found.print(format!("vertices  {}, {} local directions each", counted(vertices.len()), u32::from(side).pow(2)));
    note_rays(&mut found, &counts);
    found.print(format!(
        "transfer  {} x {}, {} values other than 0: {:.2} %",
        counted(rows),
        counted(LIGHT_TEXELS),
        counted(nonzeros),
        100.0 * nonzeros as f64 / (rows as f64 * LIGHT_TEXELS as f64)
    ));
    note_vertices(&mut found, &vertices, &[]);
    caster.record().iter().for_each(|record| record.report(&mut found));
    written(&mut found, [("out", Some(path))]);
    Ok(found)
}
