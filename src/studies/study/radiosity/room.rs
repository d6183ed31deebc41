//! Computation of the form factors of the patches.

use std::sync::Arc;

use super::{Factors, Parameters, ProgressFn};
use crate::geom::exact::Sides;
use crate::radiosity::form_factor::{Hemicube, RowSums};
use crate::radiosity::{FormFactors, Patches};
use crate::study::StudyError;
use crate::tracer::HostTracer;

/// Form factors, with their errors before anything was enforced.
pub(super) struct Room {
    pub(super) factors: FormFactors,
    pub(super) found_sums: RowSums,
    pub(super) reciprocity_error: f64,
}

pub(super) fn find(
    patches: &Patches,
    parameters: &Parameters,
    progress: &mut ProgressFn<'_>,
) -> Result<Room, StudyError> {
    let wishes = &parameters.factors;
    let mut done = |done: usize, of: usize| progress("form factors", done as u64, of as u64);
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
