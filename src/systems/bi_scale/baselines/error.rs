//! Errors of storing transfer.

use crate::error::{InputError, input_error};
use crate::transfer::grid::LIGHT_TEXELS;

/// The matrix does not have a column for each light texel.
pub fn columns_error(found: usize) -> InputError {
    input_error!("expected a matrix of {LIGHT_TEXELS} columns, a light texel each, found {found}")
}

/// The matrix has no principal components.
pub(super) fn dark_error() -> InputError {
    input_error!("expected a row with a value other than 0, found none")
}
