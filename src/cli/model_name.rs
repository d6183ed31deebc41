//! A mesh by name or from a file.

use std::path::Path;

use super::{Problem, scene_name, view};
use crate::geom::Mesh;
use crate::io::scene_file::load;
use crate::names::did_you_mean;
use crate::scene::built::{self, stand_ins};

/// The path, unless it is the name of a stand-in or of a scene of the project.
pub(super) fn named_file(path: &Path) -> Vec<&Path> {
    if stand_ins::names().any(|name| path == Path::new(name)) { Vec::new() } else { scene_name::named_file(path) }
}

/// The mesh of a stand-in, of a scene by its name, or of a file, with the normals that it has.
pub(super) fn mesh(path: &Path) -> miette::Result<Mesh> {
    let name = path.to_str().unwrap_or_default();
    if let Some(mesh) = stand_ins::build(name) {
        return Ok(mesh);
    }
    if let Some(scene) = built::build(name) {
        return Ok(scene.mesh_with_normals());
    }
    // A word without a dot or a folder is a name, not a file.
    if !path.exists() && path.components().count() == 1 && !name.contains('.') {
        let names: Vec<&str> = stand_ins::names().chain(built::names()).collect();
        let meant = did_you_mean(name, names.iter().copied());
        let help = format!("{meant}there are {}; a file needs its ending, as in `{name}.obj`", names.join(", "));
        return Err(Problem::usage(format!("there is no model `{name}`"), help).into());
    }
    view::require_mesh(path)?;
    Ok(load(path)?.mesh_with_normals())
}
