//! The model of a `.prt` file: its mesh, and the vertices that transfer belongs to.

use std::path::Path;

use crate::cli::model_name::{self, Model};
use crate::cli::{Problem, model_file, view};
use crate::scene::Material;
use crate::transfer::clustering::Clustering;
use crate::transfer::file::{MeshDigest, PrtFile, PrtMeaning, load_prt};
use crate::transfer::{Tangents, TransferError, Vertices};

/// The model. Where tangents come from texture coordinates, a file is read as a mesh, without materials: scenes have
/// none.
pub(super) fn load(path: &Path, tangents: Tangents) -> miette::Result<Model> {
    if tangents == Tangents::Texture && path.is_file() {
        return Ok(Model::plain(model_file::mesh(path)?));
    }
    model_name::model(path)
}

/// The vertices that transfer is computed at.
pub(super) fn vertices(model: &Model, tangents: Tangents) -> miette::Result<Vertices> {
    Ok(Vertices::with_materials(&model.mesh, &model.material_of, tangents).map_err(refused)?)
}

/// A `.prt` file with the model that it was made from.
pub(super) struct FileOfModel {
    pub(super) file: PrtFile,
    pub(super) model: Model,
    /// The points of the file, with tangents as the file says.
    pub(super) vertices: Vertices,
    pub(super) digest: MeshDigest,
}

impl FileOfModel {
    pub(super) fn load(path: &Path, model: &Path) -> miette::Result<Self> {
        let file = load_prt(path, None)?;
        let tangents = file.mesh.map(|mesh| mesh.tangents).unwrap_or_default();
        let model = load(model, tangents)?;
        let vertices = vertices(&model, tangents)?;
        let digest = MeshDigest::new(&vertices);
        file.require_mesh(&digest, path)?;
        Ok(Self { file, model, vertices, digest })
    }
}

/// The order of the light that a file's transfer takes.
pub(super) fn light_order(file: &PrtFile) -> Result<usize, Problem> {
    match file.meaning {
        PrtMeaning::Transfer { light_order, .. } => Ok(light_order as usize),
        PrtMeaning::Numbers { .. } => Err(Problem::usage(
            "expected transfer, found numbers without a meaning",
            "compress a file that `crossbar prt precompute` wrote",
        )),
    }
}

/// Why there is no transfer of a model.
pub(super) fn refused(error: TransferError) -> Problem {
    Problem::usage(error.to_string(), "see `crossbar prt precompute --help`")
}

/// A `.prt` file that has clusters, and these.
pub(super) fn clusters(path: &Path) -> miette::Result<(PrtFile, Clustering)> {
    view::require_file(path, 2, "name a smaller file")?;
    let mut file = load_prt(path, None)?;
    let clustering = clusters_of(&mut file, path)?;
    Ok((file, clustering))
}

/// The clusters of a file, taken out of it.
pub(super) fn clusters_of(file: &mut PrtFile, path: &Path) -> miette::Result<Clustering> {
    Ok(file.clustering.take().ok_or_else(|| {
        let what = format!("{}: expected clusters, found transfer alone", path.display());
        Problem::usage(what, "`crossbar prt compress` makes them")
    })?)
}

/// The materials of a model and that of each triangle: of a file that was read without them, those that it names.
pub(super) fn materials_of(path: &Path, model: &Model) -> miette::Result<(Vec<Material>, Vec<u32>)> {
    if !path.is_file() {
        return Ok((model.materials.clone(), model.material_of.clone()));
    }
    let with_materials = model_name::model(path)?;
    if with_materials.material_of.len() != model.mesh.len() {
        let what = format!(
            "{}: expected {} triangles with materials, found {}",
            path.display(),
            model.mesh.len(),
            with_materials.material_of.len()
        );
        return Err(Problem::usage(what, "name the model's own file, not a scene").into());
    }
    Ok((with_materials.materials, with_materials.material_of))
}
