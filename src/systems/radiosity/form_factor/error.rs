//! Errors of form factors.

use crate::error::{InputError, input_error};
use crate::tracer::CastError;

pub(super) fn value_error(expected: &'static str, value: f64, patch: usize) -> InputError {
    input_error!("radiosity::form_factors" => "expected {expected}, found {value} for patch {patch} (counted from 0)")
}

pub(super) fn no_samples_error() -> InputError {
    input_error!("radiosity::form_factors" => "expected 1 sample or more along a side of a patch, found 0")
}

/// The ray caster failed.
pub(super) fn cast_error(error: CastError) -> InputError {
    InputError::of("radiosity::form_factors", error)
}
