//! Meshes and scenes from a model file of any format.

use std::io;
use std::path::Path;

use super::error::ModelError;
use super::gltf::parse_gltf;
use super::obj::{MAX_BYTES, load_model, parse_obj};
use super::ply::parse_ply;
use super::read_limited;
use super::scene_obj::{parse_scene, plain_scene};
use crate::geom::Mesh;
use crate::scene::Scene;

/// The format of a model.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ModelFormat {
    Obj,
    Ply,
    Gltf,
}

impl ModelFormat {
    /// By the ending of the name or the first bytes; what is nothing else is taken for an OBJ file.
    fn of(bytes: &[u8], path: &Path) -> Self {
        let ending = |known: &str| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(known));
        if ending("ply") || bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            Self::Ply
        } else if ending("gltf") || ending("glb") || bytes.starts_with(b"glTF") {
            Self::Gltf
        } else {
            Self::Obj
        }
    }
}

/// Reads a mesh from an OBJ, PLY or glTF file.
///
/// # Errors
/// [`ModelError`], with the path, and the line, element or part where there is one.
pub fn load_mesh(path: &Path) -> Result<Mesh, ModelError> {
    let bytes = load_model(path)?;
    match ModelFormat::of(&bytes, path) {
        ModelFormat::Obj => parse_obj(&bytes, path),
        ModelFormat::Ply => parse_ply(&bytes, path),
        ModelFormat::Gltf => Ok(parse_gltf(&bytes, path, &mut beside(path))?.mesh().clone()),
    }
}

/// Reads a scene from an OBJ file and the libraries that it names, from a glTF file and its buffers, or from a PLY
/// file, all of one grey material. It has no views and no point lights.
///
/// # Errors
/// [`ModelError`], with the path, and the line, element or part where there is one.
pub fn load_scene(path: &Path) -> Result<Scene, ModelError> {
    let bytes = load_model(path)?;
    match ModelFormat::of(&bytes, path) {
        ModelFormat::Obj => parse_scene(&bytes, path, &mut beside(path)),
        ModelFormat::Ply => plain_scene(parse_ply(&bytes, path)?, path),
        ModelFormat::Gltf => parse_gltf(&bytes, path, &mut beside(path)),
    }
}

/// Reads files in the folder of a model.
fn beside(model: &Path) -> impl FnMut(&Path) -> io::Result<Vec<u8>> + '_ {
    let folder = model.parent().unwrap_or(Path::new(""));
    move |file| {
        let bytes = read_limited(&folder.join(file), MAX_BYTES)?;
        bytes.ok_or_else(|| io::Error::new(io::ErrorKind::FileTooLarge, "the file is longer than 256 MiB"))
    }
}
