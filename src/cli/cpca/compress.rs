//! `crossbar cpca compress`: clustered principal components of any signal.

use std::path::PathBuf;

use serde_json::json;

use super::coherence::{Coherence, CoherenceArgs};
use super::compress_report::{most_vectors, steps_document, table};
use crate::cli::study::written;
use crate::cli::words::{counted, measured};
use crate::cli::{Problem, ProgressBar, given};
use crate::clustering::{
    Clustering, Compression, CpcaError, CpcaForm, CpcaMethod, CpcaOptions, CpcaStep, Signal, compress,
};
use crate::options::number;
use crate::options::one_of::{name, variants};
use crate::report::Findings;
use crate::study::prt::CompressionError;
use crate::transfer::file::{PrtFile, save_prt};
use crate::transfer::load_signal;

const EXAMPLES: &str = "\
Examples:
  crossbar cpca compress docs/examples/step.npz --clusters 8 --vectors 3 --out small.npz
      each vertex as the mean of its cluster and three weighted vectors
  crossbar cpca compress docs/examples/step.npz --clusters 4 --vectors 2 --method adaptive --json --out small.npz
      vectors redistributed among the clusters; every step's error as JSON
  crossbar cpca compress docs/examples/signal.csv --clusters 3 --vectors 1 --out small.npz
      a signal of your own, a line of numbers per point
  crossbar cpca compress docs/examples/step.npz --clusters 8 --vectors 3 --model docs/examples/step.obj --reclassify 0.05 --out small.npz
      fewer triangles drawn in two clusters, for 5 % more error

CSV and NumPy arrays hold a row per point. The output file holds the clusters and their provenance.";

/// Maximum number of iterations per number of vectors, and maximum number of rounds of redistribution.
const ITERATIONS: usize = 10;
/// Seed of the start points.
const SEED: u64 = 1;

/// Compress transfer, or any signal, by clustered principal components
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A .npz file with transfer, a CSV table or an array of NumPy's (.npy)
    #[arg(value_name = "SIGNAL")]
    signal: PathBuf,

    /// Clusters: 1 to as many as there are points [default: 256]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=u32::MAX))]
    clusters: Option<u32>,

    /// Vectors per cluster; 0 is vector quantisation [default: 8, or as many as a point has numbers]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(0..=u32::MAX))]
    vectors: Option<u32>,

    /// How points are assigned to clusters [default: iterative]
    #[arg(long, value_name = "HOW", value_parser = variants::<CpcaMethod>())]
    method: Option<CpcaMethod>,

    /// The file to write
    #[arg(long, value_name = "Y.npz")]
    out: PathBuf,

    #[command(flatten)]
    coherence: CoherenceArgs,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    args.refuse_idle()?;
    let (meaning, mesh, signal) = load_signal(&args.signal)?;
    let vertices = args.coherence.vertices(&args.signal, mesh)?;
    let options = args.options(&signal)?;
    let bar = ProgressBar::new("vectors", options.vectors as u64 + 1).quicker("fewer `--clusters`");
    let observe = |step: &CpcaStep| bar.show("vectors".to_owned(), step.vectors as u64, options.vectors as u64 + 1);
    let Compression { clustering, steps } = compress(&signal, &options, observe).map_err(|error| refused(&error))?;
    drop(bar);
    let provenance = args.provenance(&options, &clustering, &steps);
    let coherence = vertices.map(|vertices| args.coherence.apply(&signal, &clustering, &vertices)).transpose()?;
    let clustering = coherence.as_ref().map_or(&clustering, |coherence| &coherence.found.clustering);
    let error = CompressionError::new(&signal, clustering);
    let file =
        PrtFile { meaning, mesh, transfer: None, clustering: Some(clustering.clone()), provenance: Some(provenance) };
    save_prt(&file, &args.out).map_err(Problem::from)?;
    Ok(findings(args, (&signal, clustering), &steps, &error, coherence.as_ref()))
}

impl Args {
    /// Rejects options that other options make useless.
    fn refuse_idle(&self) -> Result<(), Problem> {
        let no_vectors = [("--method", self.vectors == Some(0) && self.method.is_some())];
        given::refuse(
            no_vectors,
            "clusters with vectors, and `--vectors` is 0",
            "choose more `--vectors`, or leave it out",
        )?;
        given::refuse(
            [("--reclassify", self.clusters == Some(1) && self.coherence.reclassify.is_some())],
            "several clusters, and `--clusters` is 1",
            "choose more `--clusters`, or leave it out",
        )
    }

    fn method(&self) -> CpcaMethod {
        self.method.unwrap_or(CpcaMethod::Iterative)
    }

    /// Options of the compression.
    fn options(&self, signal: &Signal) -> miette::Result<CpcaOptions> {
        let most = u32::try_from(signal.dimension().min(signal.points())).unwrap_or(u32::MAX);
        let (clusters, vectors) = (self.clusters.unwrap_or(256), self.vectors.unwrap_or(most.min(8)));
        if vectors > most {
            let what = format!(
                "expected at most {most} `--vectors`, the lesser of points and numbers per point, found {vectors}"
            );
            return Err(Problem::usage(what, "more vectors do not help").into());
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
        let mut parts = vec![
            format!("clusters={}", clustering.subspaces().len()),
            format!("vectors={vectors}"),
            format!("method={}", name(&self.method())),
            "form=affine".to_owned(),
            format!("vq-iterations={}", options.vq_iterations),
            format!("iterations={}", options.iterations),
            format!("seed={SEED}"),
        ];
        parts.extend(self.coherence.reclassify.map(|share| format!("reclassify={share}")));
        parts.join(" ")
    }
}

fn refused(error: &CpcaError) -> Problem {
    let help = match error {
        CpcaError::Clusters { .. } => "choose fewer `--clusters`, or name a larger signal",
        CpcaError::Vectors { .. } => "choose fewer `--vectors`",
        _ => "see `crossbar cpca compress --help`",
    };
    Problem::usage(error.to_string(), help)
}

fn findings(
    args: &Args,
    (signal, clustering): (&Signal, &Clustering),
    steps: &[CpcaStep],
    error: &CompressionError,
    coherence: Option<&Coherence>,
) -> Findings {
    let mut found = Findings::new("Clustered principal components");
    let (numbers, stored) = (signal.values().len(), clustering.stored_numbers());
    let (clusters, vectors) = (clustering.subspaces().len(), most_vectors(clustering));
    found.fields(json!({
        "points": signal.points(),
        "numbers_per_point": signal.dimension(),
        "clusters": clusters,
        "most_vectors": vectors,
        "stored_numbers": stored,
        "squared_error": error.total,
        "squared_signal": error.energy,
        "relative_error": error.relative(),
        "coherence": coherence.map(Coherence::document),
        "steps": steps_document(steps),
    }));
    found.table(table(steps, error.energy));
    let [points, of] = [signal.points(), signal.dimension()].map(counted);
    found.print(format!("signal    {points} points of {of} numbers"));
    let share = 100.0 * stored as f64 / numbers as f64;
    found.print(format!("stored    {} numbers in place of {}: {share:.1} %", counted(stored), counted(numbers)));
    if let Some(coherence) = coherence {
        coherence.report(error.energy, &mut found);
    }
    found.print(format!("error     {} of the signal's squares", measured(error.relative())));
    written(&mut found, [("out", Some(args.out.as_path()))]);
    found
}
