//! Errors of making a light.

use crate::error::{InputError, input_error};
use crate::transfer::grid::LIGHT_TEXELS;

pub(super) fn texels_error(found: usize) -> InputError {
    input_error!("crossbar::prt::light" => "expected {LIGHT_TEXELS} texels, six faces of 32x32, found {found}")
}

/// A sky or a rotation that makes no light.
pub(super) fn of_light(error: InputError) -> InputError {
    error.coded("crossbar::prt::light")
}
