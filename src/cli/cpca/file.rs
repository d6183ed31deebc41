//! The `.npz` files of `crossbar cpca`, and their models.

use std::path::Path;

use crate::cli::Problem;
use crate::cli::model_name::Model;
use crate::cli::transfer::model::model_of;
use crate::clustering::Clustering;
use crate::transfer::Vertices;
use crate::transfer::file::{MeshDigest, PrtFile, PrtMeaning, load_prt};

/// A `.npz` file with the model from which it was made.
pub(super) struct FileOfModel {
    pub(super) file: PrtFile,
    pub(super) model: Model,
    /// The points of the file, with the tangents that the file specifies.
    pub(super) vertices: Vertices,
    pub(super) digest: MeshDigest,
}

impl FileOfModel {
    pub(super) fn load(path: &Path, model: &Path) -> miette::Result<Self> {
        let file = load_prt(path, None)?;
        let (model, vertices, digest) = model_of(path, file.mesh, model)?;
        Ok(Self { file, model, vertices, digest })
    }
}

/// The order of the light that a file's transfer takes.
pub(super) fn light_order(file: &PrtFile) -> Result<usize, Problem> {
    match file.meaning {
        PrtMeaning::Transfer { light_order, .. } => Ok(light_order as usize),
        PrtMeaning::Numbers { .. } => Err(Problem::usage(
            "expected transfer, found a signal that is not transfer",
            "compress a file that `crossbar cpca precompute` wrote",
        )),
    }
}

/// A `.npz` file with clusters, and its clusters.
pub(super) fn clusters(path: &Path) -> miette::Result<(PrtFile, Clustering)> {
    let mut file = load_prt(path, None)?;
    let clustering = clusters_of(&mut file, path)?;
    Ok((file, clustering))
}

/// Moves the clusters out of a file.
pub(super) fn clusters_of(file: &mut PrtFile, path: &Path) -> miette::Result<Clustering> {
    Ok(file.clustering.take().ok_or_else(|| {
        let what = format!("{}: expected clusters, found transfer only", path.display());
        Problem::usage(what, "`crossbar cpca compress` makes them")
    })?)
}
