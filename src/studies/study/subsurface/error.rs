//! Codes under which the study shows errors of libraries.

use refsim::timing::TimingError;

use crate::card::CardError;
use crate::error::InputError;
use crate::study::StudyError;

/// Error of a model for which no atlas exists.
pub fn no_atlas(error: InputError) -> StudyError {
    StudyError::coded("subsurface::atlas", error)
}

/// Error of the card.
pub(in crate::study) fn no_card(error: CardError) -> StudyError {
    StudyError::coded("subsurface::card", error)
}

/// Error of the timing model.
pub(super) fn no_time(error: TimingError) -> StudyError {
    StudyError::coded("subsurface::timing", error)
}
