//! `crossbar cpca compress`: clustered principal components of any signal.

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::cli::study::written;
use crate::cli::transfer::model::model_of;
use crate::cli::words::{counted, measured};
use crate::cli::{Problem, ProgressBar, given};
use crate::clustering::{
    Clustering, Compression, CpcaForm, CpcaMethod, CpcaOptions, CpcaStep, CpcaStepKind, Signal, compress,
};
use crate::cpca::coherence::{Reclassified, reclassify};
use crate::options::number;
use crate::options::one_of::{name, variants};
use crate::report::{Cell, Findings, Table};
use crate::transfer::file::{PrtFile, save_prt};
use crate::transfer::load_signal;

const EXAMPLES: &str = "\
Examples:
  crossbar cpca compress docs/examples/step.npz --clusters 8 --vectors 3 --out small.npz
      each vertex as the mean of its cluster and three weighted vectors
  crossbar cpca compress docs/examples/step.npz --clusters 4 --vectors 2 --method adaptive --json --out small.npz
      redistributes vectors among the clusters; the error of every step as JSON
  crossbar cpca compress docs/examples/signal.csv --clusters 3 --vectors 1 --out small.npz
      your own signal, with a line of numbers per point
  crossbar cpca compress docs/examples/step.npz --clusters 8 --vectors 3 --model docs/examples/step.obj --reclassify 0.05 --out small.npz
      moves vertices so that fewer triangles lie in two clusters, for at most 5 % more error

CSV and NumPy arrays hold a row per point. The output file holds the clusters and their provenance.";

/// Maximum number of iterations per number of vectors, and maximum number of rounds of redistribution.
const ITERATIONS: usize = 10;
const SEED: u64 = 1;

/// Compress transfer, or any signal, by clustered principal components
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A .npz file with transfer, a CSV table, or a NumPy array (.npy)
    #[arg(value_name = "SIGNAL")]
    signal: PathBuf,

    /// Number of clusters: 1 to the number of points [default: 256]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=u32::MAX))]
    clusters: Option<u32>,

    /// Vectors per cluster; 0 is vector quantisation [default: 8, or fewer if a point has fewer numbers]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(0..=u32::MAX))]
    vectors: Option<u32>,

    /// How points are assigned to clusters [default: iterative]
    #[arg(long, value_name = "HOW", value_parser = variants::<CpcaMethod>())]
    method: Option<CpcaMethod>,

    /// The file to write
    #[arg(long, value_name = "Y.npz")]
    out: PathBuf,

    /// The model from which the transfer was made, as given to `precompute`
    #[arg(long, value_name = "MODEL", help_heading = "Clusters on the mesh")]
    model: Option<PathBuf>,

    /// Move vertices to clusters of their neighbours, so that fewer triangles are drawn more than once, if that
    /// increases the squared error by at most this share: 0 or more, 0.05 to 0.1 in the paper
    #[arg(long, value_name = "SHARE", value_parser = number::not_negative, requires = "model",
          help_heading = "Clusters on the mesh")]
    reclassify: Option<f64>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    args.refuse_idle()?;
    let (meaning, mesh, signal) = load_signal(&args.signal)?;
    let model = args.model.as_ref().map(|model| model_of(&args.signal, mesh, model, None)).transpose()?;
    let options = args.options(&signal)?;
    let bar = ProgressBar::new("vectors", options.vectors as u64 + 1).quicker("fewer `--clusters`");
    let observe = |step: &CpcaStep| bar.show("vectors".to_owned(), step.vectors as u64, options.vectors as u64 + 1);
    let Compression { mut clustering, steps } = compress(&signal, &options, observe).map_err(|error| {
        Problem::usage(error.to_string(), "change `--clusters` or `--vectors`, or use a larger signal")
    })?;
    drop(bar);
    let provenance = Some(args.provenance(&options, &clustering, &steps));
    let (mut moved, energy) = (None, signal.sum_of_squares());
    if let (Some((_, vertices, _)), Some(share)) = (model, args.reclassify) {
        let found = reclassify(&signal, &clustering, vertices.triangles(), share);
        let help = "give the model from which the transfer was made";
        let found = found.map_err(|error| Problem::usage(error.to_string(), help))?;
        moved = Some(moved_vertices(&found, vertices.triangles().len(), energy));
        clustering = found.clustering;
    }
    let found = findings(args, (&signal, energy), &clustering, &steps, moved);
    let file = PrtFile { meaning, mesh, transfer: None, clustering: Some(clustering), provenance };
    save_prt(&file, &args.out).map_err(Problem::from)?;
    Ok(found)
}

impl Args {
    /// Rejects options that other options make useless.
    fn refuse_idle(&self) -> Result<(), Problem> {
        let no_vectors = [("--method", self.vectors == Some(0) && self.method.is_some())];
        let more = "remove `--method`, or give `--vectors` 1 or more";
        given::refuse(no_vectors, "clusters with vectors, and `--vectors` is 0", more)?;
        let one_cluster = [("--reclassify", self.clusters == Some(1) && self.reclassify.is_some())];
        let more = "remove `--reclassify`, or give `--clusters` 2 or more";
        given::refuse(one_cluster, "several clusters, and `--clusters` is 1", more)?;
        let no_moves = [("--model", self.model.is_some() && self.reclassify.is_none())];
        given::refuse(no_moves, "`--reclassify`", "remove `--model`, or add `--reclassify`")
    }

    fn method(&self) -> CpcaMethod {
        self.method.unwrap_or(CpcaMethod::Iterative)
    }

    fn options(&self, signal: &Signal) -> Result<CpcaOptions, Problem> {
        let most = u32::try_from(signal.dimension().min(signal.points())).unwrap_or(u32::MAX);
        let (clusters, vectors) = (self.clusters.unwrap_or(256), self.vectors.unwrap_or(most.min(8)));
        if vectors > most {
            let what = format!(
                "expected at most {most} `--vectors` (the number of points, or of numbers per point if that is \
                 smaller), found {vectors}"
            );
            return Err(Problem::usage(what, "more vectors do not reduce the error"));
        }
        Ok(CpcaOptions {
            clusters: clusters as usize,
            vectors: vectors as usize,
            vq_iterations: ITERATIONS,
            iterations: ITERATIONS,
            method: self.method().with_rounds(ITERATIONS),
            form: CpcaForm::Affine,
            seed: SEED,
        })
    }

    /// Provenance of the clusters, for the file: the actual values, not the limits.
    fn provenance(&self, options: &CpcaOptions, clustering: &Clustering, steps: &[CpcaStep]) -> String {
        let vectors = steps.last().map_or(options.vectors, |step| step.vectors);
        let mut line = format!(
            "clusters={} vectors={vectors} method={} form=affine vq-iterations={ITERATIONS} iterations={ITERATIONS} \
             seed={SEED}",
            clustering.subspaces().len(),
            name(&self.method()),
        );
        self.reclassify.iter().for_each(|share| line += &format!(" reclassify={share}"));
        line
    }
}

/// The changes by reclassification (section 5 of the paper), as a line and as JSON.
fn moved_vertices(found: &Reclassified, triangles: usize, energy: f64) -> (String, Value) {
    let &Reclassified { moved, added_error, drawn, .. } = found;
    let [before, after] = drawn.map(|drawn| drawn as f64 / triangles.max(1) as f64);
    let share = measured(if energy > 0.0 { added_error / energy } else { 0.0 });
    let line = format!(
        "moved     {} vertices; the error grew by {share} of the signal's sum of squares; each triangle was drawn \
         {before:.3} times on average, now {after:.3}",
        counted(moved)
    );
    let document = json!({
        "triangles": triangles, "vertices_moved": moved, "added_squared_error": added_error,
        "triangles_drawn": { "clusters": drawn[0], "reclassified": drawn[1] },
    });
    (line, document)
}

/// Table of the last step for each number of vectors, and every redistribution; the document has all steps.
fn table(steps: &[CpcaStep], energy: f64) -> Table {
    let last = |at: usize| steps.get(at + 1).is_none_or(|next| next.vectors != steps[at].vectors);
    let shown = |(at, step): &(usize, &CpcaStep)| last(*at) || step.kind == CpcaStepKind::Redistributed;
    let row = |(at, step): (usize, &CpcaStep)| {
        let share = (energy > 0.0).then(|| Cell::measured(100.0 * step.squared_error / energy));
        let error = Cell::measured(step.squared_error);
        [(at + 1).into(), step.vectors.into(), step.kind.to_string().into(), error, share.into()]
    };
    Table::new("Steps", &["steps", "vectors", "ends", "squared error", "of the signal (%)"])
        .with(steps.iter().enumerate().filter(shown).map(row))
}

fn findings(
    args: &Args,
    (signal, energy): (&Signal, f64),
    clustering: &Clustering,
    steps: &[CpcaStep],
    moved: Option<(String, Value)>,
) -> Findings {
    let mut found = Findings::new("Clustered principal components");
    let (numbers, stored) = (signal.values().len(), clustering.stored_numbers());
    let error = clustering.squared_error(signal);
    let relative = if error > 0.0 { error / energy } else { 0.0 };
    let step = |&CpcaStep { vectors, kind, moved, squared_error }: &CpcaStep| json!({ "vectors": vectors, "step": kind.to_string(), "moved": moved, "squared_error": squared_error });
    found.fields(json!({
        "points": signal.points(),
        "numbers_per_point": signal.dimension(),
        "clusters": clustering.subspaces().len(),
        "most_vectors": clustering.subspaces().iter().map(|subspace| subspace.len()).max().unwrap_or(0),
        "stored_numbers": stored,
        "squared_error": error,
        "squared_signal": energy,
        "relative_error": relative,
        "coherence": moved.as_ref().map(|moved| &moved.1),
        "steps": steps.iter().map(step).collect::<Vec<_>>(),
    }));
    found.table(table(steps, energy));
    let [points, of] = [signal.points(), signal.dimension()].map(counted);
    found.print(format!("signal    {points} points of {of} numbers"));
    let share = 100.0 * stored as f64 / numbers as f64;
    found.print(format!("stored    {} numbers in place of {}: {share:.1} %", counted(stored), counted(numbers)));
    moved.into_iter().for_each(|moved| found.print(moved.0));
    found.print(format!("error     {} of the signal's sum of squares", measured(relative)));
    written(&mut found, [("out", Some(args.out.as_path()))]);
    found
}
