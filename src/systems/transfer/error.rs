//! Errors of computing transfer.

use crate::error::{InputError, input_error};
use crate::tracer::CastError;

pub(crate) fn differ_error(what: &'static str, found: [usize; 2]) -> InputError {
    input_error!("crossbar::prt::precompute" => "expected equal numbers of {what}, found {} and {}", found[0], found[1])
}

pub(crate) fn exit_bases_error(found: [usize; 2]) -> InputError {
    input_error!("crossbar::prt::precompute" =>
        "expected one exit basis for all materials, or one that holds the other's functions, found bases of {} and \
         {} functions", found[0], found[1])
}

pub(crate) fn out_of_range_error(what: &'static str, expected: &'static str, found: f64) -> InputError {
    input_error!("crossbar::prt::precompute" => "expected {expected} for {what}, found {found}")
}

/// The ray caster failed.
pub(crate) fn cast_error(error: CastError) -> InputError {
    InputError::of("crossbar::prt::precompute", error)
}
