//! A mesh from a file of either format.

use std::path::Path;

use thiserror::Error;

use super::obj::{MAX_BYTES, ObjError, parse_obj};
use super::ply::{PlyError, parse_ply};
use super::read_limited;
use crate::geom::Mesh;

/// Why a file is no mesh.
#[derive(Debug, Error, miette::Diagnostic)]
pub enum ModelError {
    /// An OBJ file, or one of no known kind.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Obj(#[from] ObjError),
    /// A PLY file.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Ply(#[from] PlyError),
}

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
    let read = read_limited(path, MAX_BYTES).map_err(|source| ObjError::Read { path: path.into(), source })?;
    let bytes = read.ok_or_else(|| ObjError::TooLong { path: path.into() })?;
    Ok(if is_ply(&bytes, path) { parse_ply(&bytes, path)? } else { parse_obj(&bytes, path)? })
}
