//! Computation of the form factors of the patches.

use super::{Factors, Parameters, ProgressFn};
use crate::geom::exact::Sides;
use crate::radiosity::form_factor::{FormFactorRows, RowSums};
use crate::radiosity::{FormFactors, Patches};
use crate::study::StudyError;
use crate::study::caster::{CastRecord, CasterChoice};

/// Form factors, with their row sums before closure was enforced.
pub(super) struct Room {
    pub(super) factors: FormFactors,
    pub(super) found_sums: RowSums,
    /// Statistics of the Ray Engine, if it cast the rays.
    pub(super) cast: Option<CastRecord>,
}

/// Computes the rows of some patches.
pub(super) fn rows(
    patches: &Patches,
    parameters: &Parameters,
    caster: &CasterChoice,
    is_wanted: &(dyn Fn(usize) -> bool + Sync),
    progress: &mut ProgressFn<'_>,
) -> Result<(FormFactorRows, Option<CastRecord>), StudyError> {
    let what = match caster {
        CasterChoice::Host => "form factors".to_owned(),
        CasterChoice::Engine(choice) => format!("form factors: {}", choice.card.label),
    };
    let mut done = |done: usize, of: usize| progress(&what, done as u64, of as u64);
    Ok(match parameters.options.factors {
        Factors::Unoccluded => (FormFactorRows::unoccluded(patches, is_wanted)?, None),
        Factors::Rays(how) => {
            let mut caster = caster.open_judged(patches.mesh(), Sides::Both)?;
            (FormFactorRows::with_visibility(patches, &mut caster, how, is_wanted, &mut done)?, caster.record())
        }
    })
}

/// Completes the rows of all patches, and applies the requested corrections.
pub(super) fn complete(
    (rows, cast): (FormFactorRows, Option<CastRecord>),
    patches: &Patches,
    parameters: &Parameters,
) -> Result<Room, StudyError> {
    let mut factors = rows.complete(patches);
    let found_sums = factors.summary();
    if parameters.options.enforce_closure {
        factors.enforce_closure()?;
    }
    Ok(Room { factors, found_sums, cast })
}

/// Computes the form factors of all patches.
pub(super) fn find(
    patches: &Patches,
    parameters: &Parameters,
    caster: &CasterChoice,
    progress: &mut ProgressFn<'_>,
) -> Result<Room, StudyError> {
    complete(rows(patches, parameters, caster, &|_| true, progress)?, patches, parameters)
}
