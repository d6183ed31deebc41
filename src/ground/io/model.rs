//! Meshes and scenes from model files of any supported format.

use std::io;
use std::path::Path;

use super::gltf::parse_gltf;
use super::lines::unmarked;
use super::model_note::ModelNote;
use super::obj::{MAX_BYTES, load_model, read_obj};
use super::ply::read_ply;
use super::read_limited;
use super::scene_obj::{plain_scene, read_scene};
use super::stl::{is_stl, read_stl};
use crate::error::InputError;
use crate::geom::Mesh;
use crate::scene::Scene;

#[derive(Clone, Copy, PartialEq, Eq)]
enum ModelFormat {
    Obj,
    Ply,
    Stl,
    Gltf,
}

impl ModelFormat {
    /// The format by the file name's extension or the first bytes; OBJ if neither is conclusive.
    fn of(bytes: &[u8], path: &Path) -> Self {
        let ending = |known: &str| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(known));
        let bytes = unmarked(bytes);
        if ending("ply") || bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            Self::Ply
        } else if ending("gltf") || ending("glb") || bytes.starts_with(b"glTF") {
            Self::Gltf
        } else if ending("stl") || (!ending("obj") && is_stl(bytes)) {
            Self::Stl
        } else {
            Self::Obj
        }
    }
}

/// The axis of a model file that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UpAxis {
    /// As in glTF, and in files exported with that setting.
    Y,
    /// As in this project's scenes.
    Z,
}

/// Options of reading a model file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ModelOptions {
    /// The axis of the file that points up; `None`: y for glTF and z for all others. In the result z points up.
    pub up: Option<UpAxis>,
    /// If true, unusable materials and faces are rejected and triangles stay unchanged; otherwise defects are repaired
    /// and noted.
    pub strict: bool,
}

impl ModelOptions {
    /// No repairs, and the format's own axis.
    pub const STRICT: Self = Self { up: None, strict: true };
}

/// Reads a mesh from an OBJ, PLY, STL or glTF file, without repairs.
pub fn load_mesh(path: &Path) -> Result<Mesh, InputError> {
    load_mesh_with(path, ModelOptions::STRICT).map(|(mesh, _)| mesh)
}

/// Reads a scene without repairs: from an OBJ file and its material libraries, from a glTF file and its buffers, or
/// from a PLY or STL file, which gets one grey material. It has no views and no point lights.
pub fn load_scene(path: &Path) -> Result<Scene, InputError> {
    load_scene_with(path, ModelOptions::STRICT).map(|(scene, _)| scene)
}

/// Like [`load_mesh`], with options, and notes on the model. Unless `strict`, triangles whose winding is opposite to
/// their neighbours' are flipped ([`Mesh::misoriented`]). Fails as [`load_mesh`] does.
pub fn load_mesh_with(path: &Path, options: ModelOptions) -> Result<(Mesh, Vec<ModelNote>), InputError> {
    let bytes = load_model(path)?;
    let format = ModelFormat::of(&bytes, path);
    let (mut mesh, mut notes) = mesh_of(&bytes, format, path, options.strict)?;
    if let Some(rotation) = rotation(format, options) {
        mesh = mesh.rotated(rotation);
    }
    if options.strict {
        return Ok((mesh, Vec::new()));
    }
    let (wrong, odd) = oddities(&mesh);
    notes.extend(odd);
    Ok((mesh.turned_round(&wrong), notes))
}

/// Like [`load_scene`], with options, and notes on the model. Unless `strict`, its triangles are repaired as by
/// [`load_mesh_with`], and its materials as described in [`super::scene_obj::mtl`]. Fails as [`load_scene`] does.
pub fn load_scene_with(path: &Path, options: ModelOptions) -> Result<(Scene, Vec<ModelNote>), InputError> {
    let bytes = load_model(path)?;
    let format = ModelFormat::of(&bytes, path);
    let (mut scene, mut notes) = match format {
        ModelFormat::Obj => read_scene(&bytes, path, &mut beside(path), options.strict)?,
        ModelFormat::Gltf => (parse_gltf(&bytes, path, &mut beside(path))?, Vec::new()),
        ModelFormat::Ply | ModelFormat::Stl => {
            let (mesh, notes) = mesh_of(&bytes, format, path, options.strict)?;
            (plain_scene(mesh, path)?, notes)
        }
    };
    if let Some(rotation) = rotation(format, options) {
        scene = scene.rotated(rotation);
    }
    if !options.strict {
        let (wrong, odd) = oddities(scene.mesh());
        scene = scene.turned_round(&wrong);
        notes.extend(odd);
    }
    Ok((scene, notes))
}

fn mesh_of(bytes: &[u8], format: ModelFormat, path: &Path, strict: bool) -> Result<(Mesh, Vec<ModelNote>), InputError> {
    match format {
        ModelFormat::Obj => read_obj(bytes, path, strict),
        ModelFormat::Ply => read_ply(bytes, path, strict),
        ModelFormat::Stl => read_stl(bytes, path, strict),
        ModelFormat::Gltf => Ok((parse_gltf(bytes, path, &mut beside(path))?.mesh().clone(), Vec::new())),
    }
}

/// The rotation of the requested axis to z, for coordinates from the format's reader.
fn rotation(format: ModelFormat, options: ModelOptions) -> Option<fn([f32; 3]) -> [f32; 3]> {
    match (options.up?, format == ModelFormat::Gltf) {
        (UpAxis::Y, false) => Some(|[x, y, z]| [x, -z, y]),
        // The glTF reader has already rotated y up to z up, which is reverted.
        (UpAxis::Z, true) => Some(|[x, y, z]| [x, z, -y]),
        (UpAxis::Y, true) | (UpAxis::Z, false) => None,
    }
}

/// The triangles to flip, and notes on defects of a mesh. Triangles without an area are ignored when the triangles at
/// an edge are counted.
fn oddities(mesh: &Mesh) -> (Vec<u32>, Vec<ModelNote>) {
    let wrong = mesh.misoriented();
    let crowded = mesh.welded_with_area().0.edges().iter().filter(|edge| !edge.is_manifold()).count();
    let notes = [
        (wrong.len(), ModelNote::TurnedRound { triangles: wrong.len() }),
        (mesh.degenerate_count(), ModelNote::Degenerate { triangles: mesh.degenerate_count() }),
        (crowded, ModelNote::CrowdedEdges { edges: crowded }),
    ];
    (wrong, notes.into_iter().filter(|(count, _)| *count > 0).map(|(_, note)| note).collect())
}

fn beside(model: &Path) -> impl FnMut(&Path) -> io::Result<Vec<u8>> + '_ {
    let folder = model.parent().unwrap_or(Path::new(""));
    move |file| {
        let bytes = read_limited(&folder.join(file), MAX_BYTES)?;
        bytes.ok_or_else(|| io::Error::new(io::ErrorKind::FileTooLarge, "the file is longer than 256 MiB"))
    }
}
