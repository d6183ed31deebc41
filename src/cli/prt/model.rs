//! The model of a `.prt` file: its mesh, and the vertices that transfer belongs to.

use std::path::Path;

use super::values::TangentsArg;
use crate::cli::model_name::{self, Model};
use crate::cli::{Problem, view};
use crate::io::load_mesh;
use crate::prt::cpca::Clustering;
use crate::prt::file::{MeshDigest, PrtFile, load_prt};
use crate::prt::transfer::{Tangents, TransferError, Vertices};

/// The model. Where tangents are from texture coordinates, a file is read as a mesh, without materials: scenes have
/// none.
pub(super) fn load(path: &Path, tangents: TangentsArg) -> miette::Result<Model> {
    if tangents.0 == Tangents::Texture && path.is_file() {
        view::require_mesh(path)?;
        return Ok(Model::plain(load_mesh(path)?));
    }
    model_name::model(path)
}

/// The vertices that transfer is computed at.
pub(super) fn vertices(model: &Model, tangents: TangentsArg) -> miette::Result<Vertices> {
    Ok(Vertices::with_materials(&model.mesh, &model.material_of, tangents.0).map_err(refused)?)
}

/// Why there is no transfer of a model.
pub(super) fn refused(error: TransferError) -> Problem {
    Problem::usage(error.to_string(), "see `crossbar prt precompute --help`")
}

/// A `.prt` file that has clusters, and these; of a mesh, if one is given.
pub(super) fn clusters(path: &Path, mesh: Option<&MeshDigest>) -> miette::Result<(PrtFile, Clustering)> {
    view::require_file(path, 2, "name a smaller file")?;
    let mut file = load_prt(path, mesh)?;
    let clustering = file.clustering.take().ok_or_else(|| {
        let what = format!("{}: expected clusters, found transfer alone", path.display());
        Problem::usage(what, "`crossbar prt compress` makes them")
    })?;
    Ok((file, clustering))
}
