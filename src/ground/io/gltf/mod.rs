//! glTF 2.0, as JSON (`.gltf`) and as one binary file (`.glb`).
//!
//! docs/scenes.md lists what is read, ignored and rejected. Meshes with a skin or morph targets are rejected because
//! their triangles differ from the stored ones. glTF has y up, scenes have z up: (x, y, z) becomes (x, -z, y). Positions
//! are transformed in double precision and rounded once. The crate gltf reads the JSON and checks its references; this
//! module reads the buffers within bounds.

mod accessor;
mod buffers;
mod document;
mod geometry;
mod material;
mod nodes;

use std::io;
use std::path::Path;

use super::obj::within_limit;
use crate::error::InputError;
use crate::geom::Mesh;
use crate::io::error::{mesh_error, scene_error, syntax_error};
use crate::scene::Scene;
use accessor::AccessorReader;
use buffers::Buffers;
use geometry::Geometry;
use material::Materials;

/// Reads a scene from the bytes of a glTF file; `name` is the file's name in messages, and `beside` reads a file in the
/// same folder. The scene has no views and no point lights.
pub fn parse_gltf(
    bytes: &[u8],
    name: &Path,
    beside: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<Scene, InputError> {
    within_limit(bytes, name)?;
    let (document, chunk) = document::read(bytes, name)?;
    let buffers = Buffers::load(&document, chunk, name, beside)?;
    let reader = AccessorReader { buffers: &buffers, name };
    let mut materials = Materials::of(&document, name)?;
    let mut geometry = Geometry::default();
    for instance in nodes::instances(&document, name)? {
        for primitive in instance.mesh.primitives() {
            geometry.add(&instance, &primitive, &mut materials, &reader)?;
        }
    }
    if geometry.triangles.is_empty() {
        return Err(syntax_error(name, "at least one triangle in the default scene", "none"));
    }
    let (material_of, normals) = (std::mem::take(&mut geometry.material_of), geometry.corner_normals());
    let mesh: Mesh = geometry.mesh().map_err(|reason| mesh_error(name, reason))?;
    Scene::new(mesh, materials.list, material_of, normals).map_err(|reason| scene_error(name, reason))
}
