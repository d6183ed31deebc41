//! Errors of factorization.

use crate::error::InputError;

/// The singular values cannot be had.
pub(super) fn of_svd(error: InputError) -> InputError {
    error.coded("crossbar::factor::svd")
}
