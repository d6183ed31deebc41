//! Errors of reading files of transfer.

use std::path::Path;

use super::MeshDigest;
use crate::error::{InputError, input_error};

/// The file belongs to another mesh.
pub fn other_mesh_error(path: &Path, expected: MeshDigest, found: Option<MeshDigest>) -> InputError {
    input_error!("crossbar::prt::mesh" =>
        "expected transfer of a mesh with {expected}, found that of {}",
        found.map_or_else(|| "no mesh".to_owned(), |found| found.to_string());
        help "name the model that it was made from, or make it anew with `precompute`")
    .at(path)
}
