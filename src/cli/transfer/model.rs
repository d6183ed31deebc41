//! The model of a `.npz` file: its mesh, and the vertices to which the transfer belongs.

use std::path::{Path, PathBuf};

use refsim::machine::ExecutorKind;
use serde_json::json;

use super::values::tangents;
use crate::cli::model_name::{self, Model, transfer_model_help};
use crate::cli::words::counted;
use crate::cli::{Problem, model_file};
use crate::error::InputError;
use crate::report::Findings;
use crate::scene::Material;
use crate::study::caster::{CasterChoice, CasterOptions};
use crate::study::prt::creased;
use crate::transfer::file::{MeshDigest, require_mesh};
use crate::transfer::visibility::VisibilityCounts;
use crate::transfer::{Tangents, Vertices};

/// A model whose transfer is computed, and the file for it.
#[derive(Debug, clap::Args)]
pub(in crate::cli) struct ModelArgs {
    // Names come from the one list of built models, `meshes`.
    #[arg(value_name = "MODEL", help = transfer_model_help())]
    pub(in crate::cli) model: PathBuf,

    /// The source of the tangents of local frames: `any`, `texture` (then the file's materials are not read), or an
    /// axis X,Y,Z
    #[arg(long, value_name = "FROM", default_value = "any", value_parser = tangents, allow_hyphen_values = true)]
    tangents: Tangents,

    /// The file to write
    #[arg(long, value_name = "X.npz")]
    pub(in crate::cli) out: PathBuf,

    #[command(flatten)]
    caster: CasterOptions,
}

impl ModelArgs {
    /// The caster, the model, and its vertices.
    pub(in crate::cli) fn load(&self, crease: Option<f64>) -> miette::Result<(CasterChoice, Model, Vertices)> {
        let caster = self.caster.choose(ExecutorKind::Batch.into())?;
        let (model, vertices) = load(&self.model, self.tangents, crease, refused)?;
        Ok((caster, model, vertices))
    }
}

/// Loads the model, and its vertices, at which transfer is computed. If tangents come from texture coordinates, a file
/// is read as a mesh without materials, since scenes have no texture coordinates. A crease angle in degrees recomputes
/// normals, smooth over edges up to this angle. `refused` converts the reason why there can be no vertices.
fn load(
    path: &Path,
    tangents: Tangents,
    crease: Option<f64>,
    refused: impl FnOnce(InputError) -> Problem,
) -> miette::Result<(Model, Vertices)> {
    let mut model = match tangents == Tangents::Texture && path.is_file() {
        true => Model::plain(model_file::mesh(path)?),
        false => model_name::model(path)?,
    };
    if let Some(degrees) = crease {
        model.mesh = creased(&model.mesh, degrees);
    }
    let vertices = Vertices::with_materials(&model.mesh, &model.material_of, tangents).map_err(refused)?;
    Ok((model, vertices))
}

/// The model of a file's mesh, with its vertices, which are the file's points.
pub(in crate::cli) fn model_of(
    path: &Path,
    mesh: Option<MeshDigest>,
    model: &Path,
    crease: Option<f64>,
) -> miette::Result<(Model, Vertices, MeshDigest)> {
    let other = |error: InputError| {
        Problem::usage(error.to_string(), format!("give the model from which {} was computed", path.display()))
    };
    let tangents = mesh.map(|mesh| mesh.tangents).unwrap_or_default();
    let (model, vertices) = load(model, tangents, crease, other)?;
    let digest = MeshDigest::new(&vertices);
    require_mesh(path, &digest, mesh)?;
    Ok((model, vertices, digest))
}

/// Adds unusual vertices of a model to the findings of `precompute`: vertices without a triangle, vertices without a
/// tangent, and the nonzero counts of `more`.
pub(in crate::cli) fn note_vertices(found: &mut Findings, vertices: &Vertices, more: &[(usize, &str)]) {
    found.fields(json!({ "unused_vertices": vertices.unused, "replaced_tangents": vertices.replaced_tangents }));
    let of_model = [
        (vertices.unused, "vertices of the model belong to no triangle and were left out"),
        (
            vertices.replaced_tangents.len(),
            "vertices had a tangent parallel to their normal and got an arbitrary tangent",
        ),
    ];
    for (count, what) in of_model.iter().chain(more).filter(|(count, _)| *count > 0) {
        found.print(format!("note      {} {what}", counted(*count)));
    }
}

/// Adds the counts of traced visibility.
pub(in crate::cli) fn note_rays(found: &mut Findings, counts: &VisibilityCounts) {
    found.fields(json!({
        "directions_above": counts.above, "rays_traced": counts.traced, "directions_visible": counts.visible,
        "unclear_vertices": counts.unclear,
    }));
    let [above, traced, visible] = [counts.above, counts.traced, counts.visible].map(|count| counted(count as usize));
    found
        .print(format!("rays      {traced} traced; {visible} of {above} directions above the horizon reach the light"));
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
    let Model { materials, material_of, .. } = model_name::model(path)?;
    let [expected, found] = [model.mesh.len(), material_of.len()];
    if expected != found {
        let what = format!("{}: expected {expected} triangles with materials, found {found}", path.display());
        return Err(Problem::usage(what, "give the file of the model itself, not a scene").into());
    }
    Ok((materials, material_of))
}
