//! Reclassification of vertices, so that clusters cross fewer triangles of a mesh.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::cli::transfer::model::model_of;
use crate::cli::words::{counted, measured};
use crate::cli::{Problem, given};
use crate::clustering::{Clustering, Signal};
use crate::cpca::coherence::{Reclassified, reclassify};
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
    pub(super) reclassify: Option<f64>,
}

/// Clusters on their mesh.
pub(super) struct Coherence {
    triangles: usize,
    pub(super) found: Reclassified,
}

impl CoherenceArgs {
    /// The mesh's vertices, if vertices are to be reclassified.
    pub(super) fn vertices(&self, signal: &Path, mesh: Option<MeshDigest>) -> miette::Result<Option<Vertices>> {
        let Some(model) = &self.model else { return Ok(None) };
        given::refuse([("--model", self.reclassify.is_none())], "`--reclassify`", "name it, or leave the model out")?;
        Ok(Some(model_of(signal, mesh, model)?.1))
    }

    /// Reclassifies vertices.
    pub(super) fn apply(
        &self,
        signal: &Signal,
        clustering: &Clustering,
        vertices: &Vertices,
    ) -> Result<Coherence, Problem> {
        let triangles = vertices.triangles();
        let found = reclassify(signal, clustering, triangles, self.reclassify.unwrap_or(0.0));
        let help = "name the model that the transfer was made from";
        let found = found.map_err(|error| Problem::usage(error.to_string(), help))?;
        Ok(Coherence { triangles: triangles.len(), found })
    }
}

impl Coherence {
    /// Prints the changes. `energy` is the signal's sum of squares.
    pub(super) fn report(&self, energy: f64, found: &mut Findings) {
        let [before, after] = self.found.drawn.map(|drawn| drawn as f64 / self.triangles.max(1) as f64);
        let share = if energy > 0.0 { self.found.added_error / energy } else { 0.0 };
        found.print(format!(
            "moved     {} vertices, for {} of the signal's squares; triangles drawn {before:.3} times, then {after:.3}",
            counted(self.found.moved),
            measured(share)
        ));
    }

    /// The changes as JSON.
    pub(super) fn document(&self) -> Value {
        let [clusters, reclassified] = self.found.drawn;
        json!({
            "triangles": self.triangles,
            "vertices_moved": self.found.moved,
            "added_squared_error": self.found.added_error,
            "triangles_drawn": { "clusters": clusters, "reclassified": reclassified },
        })
    }
}
