//! A model by name or from a file.

use std::path::Path;

use super::{given, model_file, scene_name};
use crate::geom::Mesh;
use crate::io::scenes;
use crate::scene::built::flat_models::MaterialMesh;
use crate::scene::built::meshes;
use crate::scene::{Material, Scene};

/// The material of models that have none: reflectance 0.5.
const PLAIN: [f32; 3] = [0.5; 3];

/// A mesh with its own normals, and a material per triangle.
pub(super) struct Model {
    pub(super) mesh: Mesh,
    pub(super) materials: Vec<Material>,
    pub(super) material_of: Vec<u32>,
}

impl Model {
    pub(super) fn plain(mesh: Mesh) -> Self {
        Self { material_of: vec![0; mesh.len()], materials: vec![Material::diffuse("plain", PLAIN)], mesh }
    }

    fn of(scene: &Scene) -> Self {
        let (materials, material_of) = (scene.materials().to_vec(), scene.material_of().to_vec());
        Self { mesh: scene.mesh_with_normals(), materials, material_of }
    }
}

/// The help of an argument that takes a model, with the names of the stand-ins for models in the papers on transfer.
pub(super) fn transfer_model_help() -> String {
    let stands_in = |name: &&str| ["transfer-", "all-frequency-", "bi-scale-"].iter().any(|of| name.starts_with(of));
    let names: Vec<&str> = meshes::names().filter(stands_in).collect();
    format!(
        "A Wavefront OBJ, PLY, STL or glTF file, a scene file (.toml), a built-in scene, or a stand-in for a model of \
         the papers: {}",
        names.join(", ")
    )
}

/// The path, unless it names a mesh or scene of the project.
pub(super) fn named_file(path: &Path) -> Vec<&Path> {
    if meshes::names().any(|name| path == Path::new(name)) { Vec::new() } else { scene_name::named_file(path) }
}

/// A mesh of the project, or the mesh of a scene of the project or of a file, with its own normals.
pub(super) fn mesh(path: &Path) -> miette::Result<Mesh> {
    Ok(model(path)?.mesh)
}

/// The model with materials, found by the same rules as [`mesh`].
pub(super) fn model(path: &Path) -> miette::Result<Model> {
    let name = path.to_str().unwrap_or_default();
    if let Some(MaterialMesh { mesh, materials, material_of }) = meshes::build_with_materials(name) {
        model_file::refuse_options(name)?;
        return Ok(Model { mesh, materials, material_of });
    }
    if let Some(scene) = scenes::named(name) {
        model_file::refuse_options(name)?;
        return Ok(Model::of(&scene));
    }
    given::require_file(path, "model", &meshes::names().chain(scenes::names()).collect::<Vec<_>>(), "obj")?;
    Ok(Model::of(&model_file::scene(path)?))
}
