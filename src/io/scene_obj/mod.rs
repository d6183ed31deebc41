//! Wavefront OBJ with materials: a whole scene.
//!
//! Geometry is read as by [`super::obj`] (checked line by line, then handed to tobj); beyond it, `vn` and the normals
//! of corners, `mtllib` and `usemtl` count. A triangle with a normal at each corner is round, one without is flat. A
//! face without material, or with one that no library has, is grey. Libraries are named by the rest of their line and
//! lie beside the model ([`mtl`]).
//!
//! [`write`] gives text that reads back with the same bits.

pub mod mtl;
mod reader;
mod write;

use std::io;
use std::path::Path;

pub use mtl::parse_mtl;
pub use write::{write_mtl, write_scene};

use super::error::ModelError;
use super::lines::{logical_lines, words};
use super::model::is_ply;
use super::obj::{MAX_BYTES, load_model, within_limit};
use super::ply::parse_ply;
use super::read_limited;
use crate::scene::Scene;
use reader::SceneReader;

/// Reads a scene from an OBJ file and the libraries that it names, or from a PLY file, all of one grey material. It has
/// no views and no point lights.
///
/// # Errors
/// [`ModelError`], with the path, and the line where there is one.
pub fn load_scene(path: &Path) -> Result<Scene, ModelError> {
    let bytes = load_model(path)?;
    if is_ply(&bytes, path) {
        return reader::plain_scene(parse_ply(&bytes, path)?, path);
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    parse_scene(&bytes, path, &mut |library| {
        let file = folder.join(library);
        let bytes = read_limited(&file, MAX_BYTES)?;
        bytes.ok_or_else(|| io::Error::new(io::ErrorKind::FileTooLarge, "the file is longer than 256 MiB"))
    })
}

/// Reads a scene from bytes; `name` stands for the file in messages, and `library` gives the bytes of a material
/// library. No input makes it panic.
///
/// # Errors
/// [`ModelError`], with the line where there is one.
pub fn parse_scene(
    bytes: &[u8],
    name: &Path,
    library: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<Scene, ModelError> {
    within_limit(bytes, name)?;
    let mut reader = SceneReader::new(name);
    for (line, text) in logical_lines(bytes) {
        reader.line(line, &words(&text), &text, library)?;
    }
    reader.scene()
}
