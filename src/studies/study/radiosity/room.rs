//! Computation of the form factors of the patches.

use super::{Factors, Parameters, ProgressFn};
use crate::geom::exact::Sides;
use crate::radiosity::form_factor::RowSums;
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

/// Computes the form factors of all patches, and applies the requested corrections.
pub(super) fn find(
    patches: &Patches,
    parameters: &Parameters,
    caster: &CasterChoice,
    progress: &mut ProgressFn<'_>,
) -> Result<Room, StudyError> {
    let what = match caster {
        CasterChoice::Host => "form factors".to_owned(),
        CasterChoice::Engine(choice) => format!("form factors: {}", choice.card.label),
    };
    let mut done = |done: usize, of: usize| progress(&what, done as u64, of as u64);
    let (mut factors, cast) = match parameters.options.factors {
        Factors::Unoccluded => (FormFactors::unoccluded(patches)?, None),
        Factors::Rays(how) => {
            let mut caster = caster.open_judged(patches.mesh(), Sides::Both)?;
            (FormFactors::with_visibility(patches, &mut caster, how, &mut done)?, caster.record())
        }
    };
    let found_sums = factors.summary();
    if parameters.options.enforce_closure {
        factors.enforce_closure()?;
    }
    Ok(Room { factors, found_sums, cast })
}
