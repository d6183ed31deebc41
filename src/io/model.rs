//! A mesh from a file of either format.

use std::path::Path;

use super::error::ModelError;
use super::obj::{load_model, parse_obj};
use super::ply::parse_ply;
use crate::geom::Mesh;

/// Whether a model is a PLY file: by its first line, or by the ending of its name.
pub(super) fn is_ply(bytes: &[u8], path: &Path) -> bool {
    let ending = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("ply"));
    ending || bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")
}

/// Reads a mesh from a PLY or OBJ file.
///
/// # Errors
/// [`ModelError`], with the path, and the line or element where there is one.
pub fn load_mesh(path: &Path) -> Result<Mesh, ModelError> {
    let bytes = load_model(path)?;
    if is_ply(&bytes, path) { parse_ply(&bytes, path) } else { parse_obj(&bytes, path) }
}
