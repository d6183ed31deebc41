//! Optimisation of clusters for drawing on a mesh: vertices are reclassified, clusters are drawn together.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::cli::transfer::model::model_of;
use crate::cli::words::{counted, measured};
use crate::cli::{Problem, given};
use crate::clustering::{Clustering, Signal};
use crate::cpca::coherence::{Superclusters, overdraw, reclassify};
use crate::options::number;
use crate::report::Findings;
use crate::transfer::Vertices;
use crate::transfer::file::MeshDigest;

/// Optimisation of clusters for drawing (section 5 of the paper).
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Clusters on the mesh")]
pub(super) struct CoherenceArgs {
    /// The model that the transfer was made from, as it was given to `precompute`
    #[arg(long, value_name = "MODEL")]
    model: Option<PathBuf>,

    /// Move vertices to clusters of their neighbours, so that fewer triangles are drawn more than once, if that
    /// increases the squared error by at most this share: 0 or more, 0.05 to 0.1 in the paper
    #[arg(long, value_name = "SHARE", value_parser = number::not_negative, requires = "model")]
    reclassify: Option<f64>,

    /// Group clusters to be drawn as one, at most this many per group, for all cards: 2 or more [default: `card` draws
    /// as many as its registers hold]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..), requires = "model")]
    supercluster_size: Option<u32>,
}

/// Clusters on their mesh.
pub(super) struct Coherence {
    pub(super) clustering: Clustering,
    /// The supercluster of each cluster, if requested.
    pub(super) superclusters: Option<Vec<u32>>,
    triangles: usize,
    /// Vertices moved, and the squared error that moves added.
    moved: Option<(usize, f64)>,
    /// Number of triangles drawn: with the original clusters, after reclassification, in superclusters.
    drawn: [u64; 3],
}

impl CoherenceArgs {
    /// The mesh's vertices, if an option needs them.
    pub(super) fn vertices(&self, signal: &Path, mesh: Option<MeshDigest>) -> miette::Result<Option<Vertices>> {
        let Some(model) = &self.model else { return Ok(None) };
        let is_idle = self.reclassify.is_none() && self.supercluster_size.is_none();
        let help = "name one of these, or leave the model out";
        given::refuse([("--model", is_idle)], "`--reclassify` and `--supercluster-size`", help)?;
        Ok(Some(model_of(signal, mesh, model)?.1))
    }

    /// Whether reclassification is requested, and whether superclusters are.
    pub(super) const fn given(&self) -> [bool; 2] {
        [self.reclassify.is_some(), self.supercluster_size.is_some()]
    }

    /// The options that were given, as the file stores them.
    pub(super) fn provenance(&self) -> Vec<String> {
        let reclassify = self.reclassify.map(|share| format!("reclassify={share}"));
        let size = self.supercluster_size.map(|size| format!("supercluster-size={size}"));
        [reclassify, size].into_iter().flatten().collect()
    }

    /// Reclassifies vertices and groups clusters, if requested.
    pub(super) fn apply(
        &self,
        signal: &Signal,
        mut clustering: Clustering,
        vertices: &Vertices,
    ) -> Result<Coherence, Problem> {
        let failed = |error: String| Problem::usage(error, "name the model that the transfer was made from");
        let triangles = vertices.triangles();
        let before = overdraw(triangles, clustering.of_point());
        let (mut moved, mut drawn) = (None, [before; 3]);
        if let Some(budget) = self.reclassify {
            let found = reclassify(signal, &clustering, triangles, budget).map_err(|e| failed(e.to_string()))?;
            clustering = found.clustering;
            moved = Some((found.moved, found.added_error));
            drawn = [before, found.drawn[1], found.drawn[1]];
        }
        let superclusters = match self.supercluster_size {
            None => None,
            Some(size) => {
                let made = Superclusters::of_size(&clustering, triangles, size as usize);
                let made = made.map_err(|e| failed(e.to_string()))?;
                drawn[2] = made.overdraw(&clustering, triangles);
                Some(made.of_cluster().to_vec())
            }
        };
        Ok(Coherence { clustering, superclusters, triangles: triangles.len(), moved, drawn })
    }
}

impl Coherence {
    /// Prints the changes. `energy` is the signal's sum of squares.
    pub(super) fn report(&self, energy: f64, found: &mut Findings) {
        let [before, moved, grouped] = self.drawn.map(|drawn| drawn as f64 / self.triangles.max(1) as f64);
        if let Some((count, added)) = self.moved {
            let share = if energy > 0.0 { added / energy } else { 0.0 };
            found.print(format!(
                "moved     {} vertices, for {} of the signal's squares; triangles drawn {before:.3} times, then \
                 {moved:.3}",
                counted(count),
                measured(share)
            ));
        }
        if let Some(superclusters) = &self.superclusters {
            let count = count(superclusters);
            found
                .print(format!("together  {count} superclusters; triangles drawn {moved:.3} times, then {grouped:.3}"));
        }
    }

    /// The changes as JSON.
    pub(super) fn document(&self) -> Value {
        let [clusters, reclassified, superclusters] = self.drawn;
        json!({
            "triangles": self.triangles,
            "vertices_moved": self.moved.map(|moved| moved.0),
            "added_squared_error": self.moved.map(|moved| moved.1),
            "superclusters": self.superclusters.as_deref().map(count),
            "triangles_drawn": { "clusters": clusters, "reclassified": reclassified, "superclusters": superclusters },
        })
    }
}

/// The number of superclusters.
pub(super) fn count(of_cluster: &[u32]) -> usize {
    of_cluster.iter().max().map_or(0, |&last| last as usize + 1)
}
