//! Codes under which the study shows errors of the card.

use crate::card::CardError;
use crate::study::StudyError;

/// Error of the card.
pub(in crate::study) fn no_card(error: CardError) -> StudyError {
    StudyError::coded("radiosity::card", error)
}
