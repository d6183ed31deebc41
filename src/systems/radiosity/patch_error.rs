//! Errors of cutting a scene into patches.

use crate::error::{InputError, input_error};
use crate::linalg::MAX_SQUARE;

/// Maximum number of patches: the rows of the largest matrix.
pub const MAX_PATCHES: usize = MAX_SQUARE;

pub(super) fn empty_error() -> InputError {
    input_error!("radiosity::patches" => "expected a scene with surfaces, found none")
}

pub(super) fn too_thin_error(triangle: u32) -> InputError {
    input_error!("radiosity::patches" =>
        "triangle {triangle} (counted from 0) is too thin for a patch; remove it, or merge its corners")
}
