//! Codes under which the study shows errors of libraries.

use refsim::timing::TimingError;

use crate::atlas::AtlasError;
use crate::card::CardError;
use crate::study::StudyError;
use crate::study::error::library_errors;
use crate::subsurface::MaterialError;
use crate::subsurface::factor::FactorError;
use crate::subsurface::walk::MeshWalkError;

library_errors! {
    FactorError => "subsurface::links";
    MaterialError => "subsurface::material";
    MeshWalkError => "subsurface::walk";
}

/// Error of a model without an atlas.
pub fn no_atlas(error: AtlasError) -> StudyError {
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
