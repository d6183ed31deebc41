//! Errors of form factors.

use thiserror::Error;

use crate::linalg::MatrixError;
use crate::radiosity::DrawError;
use crate::tracer::CastError;

/// Form factors cannot be computed, or do not meet what was required.
#[non_exhaustive]
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum FormFactorError {
    /// The matrix would be too large.
    #[error(transparent)]
    Size(#[from] MatrixError),
    /// The number of areas is not that of the rows.
    #[error("expected {rows} areas, one per row, found {areas}")]
    Areas { rows: usize, areas: usize },
    /// An area or form factor is out of range.
    #[error("expected {expected}, found {value} for patch {patch} (counted from 0)")]
    Value { expected: &'static str, value: f64, patch: usize },
    /// The room is not closed.
    #[error(
        "expected a closed room, found patch {patch} (counted from 0) with form factors that sum to {sum}, and {open} of {patches} \
         patches more than {tolerance} from 1 ({blind} more see nothing); close the room, or allow light to leave it"
    )]
    Open { patch: usize, sum: f64, open: usize, blind: usize, patches: usize, tolerance: f64 },
    /// Scaling cannot bring every row sum to 1.
    #[error(
        "form factors cannot be scaled to a closed room: after {rounds} rounds patch {patch} (counted from 0) still sums to {sum}"
    )]
    NoScaling { rounds: u32, patch: usize, sum: f64 },
    /// The number of samples along a side is 0.
    #[error("expected 1 sample or more along a side of a patch, found 0")]
    NoSamples,
    /// The card cannot draw a hemicube of this size.
    #[error(
        "expected an even number of pixels from 2 to {most} along a side of a hemicube, found {found}; its five faces lie in one target, \
         which {device} allows {limit} pixels a side"
    )]
    Resolution { found: u32, most: u32, device: String, limit: u32 },
    /// The card failed to draw.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The ray caster failed.
    #[error(transparent)]
    Cast(#[from] CastError),
}
