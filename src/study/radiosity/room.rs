//! From patches to form factors: where they come from, and what is asked of them.

use std::sync::Arc;

use super::{Parameters, StudyError, Watch};
use crate::geom::exact::Sides;
use crate::radiosity::form_factor::{Hemicube, RowSums, VisibilityParameters};
use crate::radiosity::{FormFactors, Patches};
use crate::tracer::HostTracer;

/// Where form factors come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factors {
    /// As if nothing stood between any two patches.
    Unoccluded,
    /// Closed forms and contour integrals, times what rays find open.
    Rays(VisibilityParameters),
    /// Pictures of the scene from each patch, drawn by the study's card.
    Hemicube {
        /// Pixels along a side of the top face.
        resolution: u32,
    },
}

/// What is asked of form factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wishes {
    /// Where they come from.
    pub from: Factors,
    /// Row sums may be so far from 1, or there is no solution.
    pub closed: Option<f64>,
    /// Make A_i F_ij and A_j F_ji equal.
    pub enforce_reciprocity: bool,
    /// Make rows sum to 1 (and pairs reciprocal).
    pub enforce_closure: bool,
}

/// Form factors with what they were before anything was enforced.
pub(super) struct Room {
    pub(super) factors: FormFactors,
    pub(super) found_sums: RowSums,
    pub(super) reciprocity_error: f64,
}

pub(super) fn find(patches: &Patches, parameters: &Parameters, watch: &mut Watch<'_>) -> Result<Room, StudyError> {
    let wishes = &parameters.factors;
    let mut done = |done: usize, of: usize| watch("form factors", done as u64, of as u64);
    let mut factors = match wishes.from {
        Factors::Unoccluded => FormFactors::unoccluded(patches)?,
        Factors::Rays(how) => {
            let mut tracer = HostTracer::new(patches.mesh(), Sides::Both);
            FormFactors::with_visibility(patches, &mut tracer, how, &mut done)?
        }
        Factors::Hemicube { resolution } => {
            let hemicube = Hemicube { resolution, device: Arc::new(parameters.profile.clone()) };
            FormFactors::hemicube(patches, &hemicube, &parameters.executor, &mut done)?
        }
    };
    let (found_sums, reciprocity_error) = (factors.summary(), factors.reciprocity_error());
    if let Some(tolerance) = wishes.closed {
        factors.require_closed(tolerance)?;
    }
    if wishes.enforce_closure {
        factors.enforce_closure()?;
    } else if wishes.enforce_reciprocity {
        factors.enforce_reciprocity();
    }
    Ok(Room { factors, found_sums, reciprocity_error })
}
