//! Errors of computing transfer.

use crate::error::{InputError, ensure};
use crate::tracer::CastError;

pub(crate) fn require(fits: bool, what: &str, expected: &str, found: f64) -> Result<(), InputError> {
    ensure!(fits, "crossbar::prt::precompute" => "expected {expected} for {what}, found {found}");
    Ok(())
}

pub(crate) fn cast_error(error: CastError) -> InputError {
    InputError::of("crossbar::prt::precompute", error)
}
