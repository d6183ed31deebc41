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
pub(super) use reader::plain_scene;
pub use write::{write_mtl, write_scene};

use super::error::ModelError;
use super::lines::{logical_lines, words};
use super::model_note::ModelNote;
use super::obj::within_limit;
use crate::scene::Scene;
use reader::SceneReader;

/// Reads a scene from bytes; `name` is the file's name in messages, and `library` reads a material library. Never
/// panics.
///
/// # Errors
/// [`ModelError`], with the line where there is one.
pub fn parse_scene(
    bytes: &[u8],
    name: &Path,
    library: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<Scene, ModelError> {
    read_scene(bytes, name, library, true).map(|(scene, _)| scene)
}

/// [`parse_scene`]; unless `strict`, materials that are none of ours are changed into such, and what was changed is
/// said.
pub(super) fn read_scene(
    bytes: &[u8],
    name: &Path,
    library: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    strict: bool,
) -> Result<(Scene, Vec<ModelNote>), ModelError> {
    within_limit(bytes, name)?;
    let mut reader = SceneReader::new(name, strict);
    for (line, text) in logical_lines(bytes) {
        reader.line(line, &words(&text), &text, library)?;
    }
    reader.scene()
}
