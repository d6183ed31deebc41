//! Computation of the form factors of the patches.

use super::{Factors, Parameters, ProgressFn};
use crate::geom::exact::Sides;
use crate::radiosity::form_factor::{FormFactorRows, RowSums};
use crate::radiosity::{FormFactors, Patches};
use crate::study::StudyError;
use crate::tracer::HostTracer;

/// Form factors, with their row sums before closure was enforced.
pub(super) struct Room {
    pub(super) factors: FormFactors,
    pub(super) found_sums: RowSums,
}

/// Computes the rows of some patches.
pub(super) fn rows(
    patches: &Patches,
    parameters: &Parameters,
    is_wanted: &(dyn Fn(usize) -> bool + Sync),
    progress: &mut ProgressFn<'_>,
) -> Result<FormFactorRows, StudyError> {
    let mut done = |done: usize, of: usize| progress("form factors", done as u64, of as u64);
    Ok(match parameters.options.factors {
        Factors::Unoccluded => FormFactorRows::unoccluded(patches, is_wanted)?,
        Factors::Rays(how) => {
            let mut tracer = HostTracer::new(patches.mesh(), Sides::Both);
            FormFactorRows::with_visibility(patches, &mut tracer, how, is_wanted, &mut done)?
        }
    })
}

/// Completes the rows of all patches, and applies the requested corrections.
pub(super) fn complete(rows: FormFactorRows, patches: &Patches, parameters: &Parameters) -> Result<Room, StudyError> {
    let mut factors = rows.complete(patches);
    let found_sums = factors.summary();
    if parameters.options.enforce_closure {
        factors.enforce_closure()?;
    }
    Ok(Room { factors, found_sums })
}

/// Computes the form factors of all patches.
pub(super) fn find(
    patches: &Patches,
    parameters: &Parameters,
    progress: &mut ProgressFn<'_>,
) -> Result<Room, StudyError> {
    complete(rows(patches, parameters, &|_| true, progress)?, patches, parameters)
}
