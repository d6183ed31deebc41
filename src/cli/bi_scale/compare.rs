//! `crossbar bi-scale compare`: biclusters compared with other ways to store transfer.

use std::path::PathBuf;

use serde_json::{Value, json};

use super::file::{cube_of, load, vertices_of};
use crate::bi_scale::baselines::columns_error;
use crate::bi_scale::baselines::{HaarRowOptions, LocalTransfer, RowClusterOptions};
use crate::bi_scale::bicluster::{BiclusterOptions, bicluster};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::file::BiScaleFile;
use crate::bi_scale::transfer::light_vectors;
use crate::cli::transfer::light::{CUBE_LIGHT, DEFAULT_LIGHT, DistantLightArg};
use crate::cli::words::counted;
use crate::cli::{Problem, ProgressBar};
use crate::report::Findings;
use crate::study::prt::{StoredComparison, StoredWay, stored_ways_table};
use crate::transfer::grid::LIGHT_TEXELS;

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale compare docs/examples/step_biclusters.npz --clusters 4 --vectors 2 --sample 300
      bytes and errors of compressed rows, clusters of rows, wavelets and harmonics, compared with biclusters
  crossbar bi-scale compare docs/examples/step_biclusters.npz --model docs/examples/step.obj --light disk:1,0,2:5 --clusters 4 --sample 300 --json
      also methods that rotate light into frames of vertices; the figures as JSON

Errors are those of the light that arrives in all local directions of all vertices, against rows of T in double precision.
docs/papers/bi_scale.md describes each method.";

/// Order of spherical harmonics, as in the paper.
const HARMONICS_ORDER: usize = 5;

/// Compare biclusters with other ways to store transfer: bytes, and the error of the light that arrives
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A matrix of 6,144 columns (.mtx or .npz), or its biclusters (.npz)
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// The model from which the file was made: also compares harmonics on both sides, and reshuffled visibility
    #[arg(long, value_name = "MODEL")]
    model: Option<PathBuf>,

    #[arg(long, value_name = "LIGHT", default_value = DEFAULT_LIGHT, allow_hyphen_values = true, help = CUBE_LIGHT)]
    light: DistantLightArg,

    /// Clusters of rows
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    clusters: u32,

    /// Vectors per cluster
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=6144))]
    vectors: u32,

    /// Number of sampled rows for the initial clusters
    #[arg(long, value_name = "N", default_value_t = 4096, value_parser = clap::value_parser!(u32).range(1..))]
    sample: u32,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let file = load(&args.file)?;
    let vertices = match &args.model {
        Some(model) => Some(vertices_of(model, &args.file, file.meaning.as_ref())?),
        None => None,
    };
    let BiScaleFile { meaning, matrix, biclusters } = file;
    let refused = |error: &dyn std::error::Error| {
        Problem::usage(format!("{}: {error}", args.file.display()), "see `crossbar bi-scale compare --help`")
    };
    let matrix = match (matrix, &biclusters) {
        (Some(matrix), _) => matrix,
        (None, Some(biclusters)) => biclusters.sum().map_err(|error| refused(&error))?,
        (None, None) => return Err(Problem::usage("no matrix", "name another file").into()),
    };
    if matrix.columns() != LIGHT_TEXELS {
        return Err(refused(&columns_error(matrix.columns())).into());
    }
    let bar = ProgressBar::new("biclusters", 1);
    let biclusters = match biclusters {
        Some(biclusters) => biclusters,
        None => bicluster(&matrix, BiclusterOptions::default(), &mut |_| ()).map_err(|error| refused(&error))?,
    };
    let cube = cube_of(&args.light, "compare")?;
    let channels = light_vectors(&cube);
    let side = meaning.map_or(1, |meaning| meaning.side as usize);
    let directions = LocalDirections::new(side).map_err(|error| refused(&error))?;
    let transfer = vertices.as_ref().map(|vertices| LocalTransfer::new(&matrix, vertices.frames(), &directions));
    let comparison = StoredComparison {
        matrix: &matrix,
        biclusters: &biclusters,
        transfer: transfer.transpose().map_err(|error| refused(&error))?,
        clusters: args.clusters(),
        wavelets: HaarRowOptions::default(),
        order: HARMONICS_ORDER,
    };
    let mut show = |what: &str, done: u64, of: u64| bar.show(what.to_owned(), done, of);
    let ways = comparison.ways(&[channels.to_vec()], &mut show, &mut |_, _| ()).map_err(|error| refused(&error))?;
    drop(bar);
    let mut found = Findings::new("Storage methods for transfer");
    found.table(stored_ways_table("Storage methods for transfer", &ways, &["light"]));
    found.fields(json!({
        "rows": matrix.rows(), "columns": matrix.columns(), "nonzeros": matrix.nonzeros(), "flux": cube.flux(),
        "ways": ways.iter().map(document).collect::<Vec<Value>>(),
    }));
    found.introduce(format!(
        "{} x {}, {} values other than 0, under {}",
        counted(matrix.rows()),
        counted(matrix.columns()),
        counted(matrix.nonzeros()),
        args.light.name()
    ));
    Ok(found)
}

impl Args {
    fn clusters(&self) -> RowClusterOptions {
        RowClusterOptions {
            clusters: self.clusters as usize,
            vectors: self.vectors as usize,
            sample: self.sample as usize,
            ..RowClusterOptions::default()
        }
    }
}

fn document(way: &StoredWay) -> Value {
    let bytes: Vec<Value> =
        way.sizes.iter().map(|size| json!({ "layout": size.layout, "bytes": size.bytes })).collect();
    let error = way.errors.first();
    json!({
        "way": way.name, "bytes": bytes, "rms": error.map(|error| error.root_mean_square),
        "largest": error.map(|error| error.largest), "relative": error.map(|error| error.relative),
        "seconds": way.seconds,
    })
}
