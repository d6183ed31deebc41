//! The model of a `.npz` file: its mesh, and the vertices to which the transfer belongs.

use std::path::Path;

use serde_json::json;

use crate::cli::model_name::{self, Model};
use crate::cli::words::counted;
use crate::cli::{Problem, model_file};
use crate::error::InputError;
use crate::report::Findings;
use crate::scene::Material;
use crate::transfer::file::{MeshDigest, require_mesh};
use crate::transfer::{Tangents, Vertices};

/// Loads the model. If tangents come from texture coordinates, a file is read as a mesh without materials, since scenes
/// have no texture coordinates.
pub(in crate::cli) fn load(path: &Path, tangents: Tangents) -> miette::Result<Model> {
    if tangents == Tangents::Texture && path.is_file() {
        return Ok(Model::plain(model_file::mesh(path)?));
    }
    model_name::model(path)
}

/// The vertices at which transfer is computed.
pub(in crate::cli) fn vertices(model: &Model, tangents: Tangents) -> miette::Result<Vertices> {
    Ok(Vertices::with_materials(&model.mesh, &model.material_of, tangents).map_err(refused)?)
}

/// The model of a file's mesh, with its vertices: the file's points.
pub(in crate::cli) fn model_of(
    path: &Path,
    mesh: Option<MeshDigest>,
    model: &Path,
) -> miette::Result<(Model, Vertices, MeshDigest)> {
    let tangents = mesh.map(|mesh| mesh.tangents).unwrap_or_default();
    let model = load(model, tangents)?;
    let (vertices, digest) = vertices_of(path, mesh, &model)?;
    Ok((model, vertices, digest))
}

/// The vertices of the model from which a file was computed.
pub(in crate::cli) fn vertices_of(
    path: &Path,
    mesh: Option<MeshDigest>,
    model: &Model,
) -> miette::Result<(Vertices, MeshDigest)> {
    let tangents = mesh.map(|mesh| mesh.tangents).unwrap_or_default();
    let other = |error: InputError| {
        Problem::usage(error.to_string(), format!("name the model that {} was computed from", path.display()))
    };
    let vertices = Vertices::with_materials(&model.mesh, &model.material_of, tangents).map_err(other)?;
    let digest = MeshDigest::new(&vertices);
    require_mesh(path, &digest, mesh)?;
    Ok((vertices, digest))
}

/// Adds unusual vertices of a model to the findings of `precompute`: vertices without a triangle, vertices without a
/// tangent, and the nonzero counts of `more`.
pub(in crate::cli) fn note_vertices(found: &mut Findings, vertices: &Vertices, more: &[(usize, &str)]) {
    found.fields(json!({ "unused_vertices": vertices.unused, "replaced_tangents": vertices.replaced_tangents }));
    let of_model = [
        (vertices.unused, "vertices of the model belong to no triangle and were left out"),
        (vertices.replaced_tangents.len(), "vertices had no tangent across their normal and got an arbitrary one"),
    ];
    for (count, what) in of_model.iter().chain(more).filter(|(count, _)| *count > 0) {
        found.print(format!("note      {} {what}", counted(*count)));
    }
}

/// Reason why the transfer of a model cannot be computed.
pub(in crate::cli) fn refused(error: InputError) -> Problem {
    Problem::usage(error.to_string(), error.advice().unwrap_or("see this command's `--help`"))
}

/// The materials of a model, and the material of each triangle; a file that was read as a mesh is read again for them.
pub(in crate::cli) fn materials_of(path: &Path, model: &Model) -> miette::Result<(Vec<Material>, Vec<u32>)> {
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
