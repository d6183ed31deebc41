//! Wavefront OBJ with materials: a whole scene.
//!
//! Geometry is read as by [`super::obj`]; in addition, `vn` and the normals of corners, `mtllib` and `usemtl` are used.
//! Names of materials and libraries extend to the end of their line. If no library of that name can be read, a `mtllib`
//! line is read as a list of names, each of which ends in `.mtl`.

pub mod mtl;
mod reader;
mod write;

use std::io;
use std::path::Path;

pub use mtl::parse_mtl;
pub(super) use reader::{DEFAULT, GREY, flat_where_unknown, plain_scene};
pub use write::{write_mtl, write_scene};

use super::lines::{logical_lines, not_utf_16, statement};
use super::model_note::ModelNote;
use super::obj::within_limit;
use crate::error::InputError;
use crate::scene::Scene;
use reader::SceneReader;

/// Reads a scene from bytes; `name` is the file's name in messages, and `library` reads a material library.
pub fn parse_scene(
    bytes: &[u8],
    name: &Path,
    library: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<Scene, InputError> {
    read_scene(bytes, name, library, true).map(|(scene, _)| scene)
}

/// Like [`parse_scene`]; unless `strict`, unsupported materials are replaced by supported ones, with a note for each
/// change.
pub(super) fn read_scene(
    bytes: &[u8],
    name: &Path,
    library: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    strict: bool,
) -> Result<(Scene, Vec<ModelNote>), InputError> {
    within_limit(bytes, name)?;
    not_utf_16(bytes, name)?;
    let mut reader = SceneReader::new(name, strict);
    for (line, text) in logical_lines(bytes) {
        reader.line(line, &statement(&text), &text, library)?;
    }
    reader.scene()
}
