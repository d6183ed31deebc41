//! The Ray Engine's rays in place of the host's: leaks of form factors, and their effect on the solution.

use super::solve::{Room, room};
use super::{Parameters, ProgressFn, SolutionError};
use crate::picture::metrics::ErrorSums;
use crate::radiosity::solve::Solver;
use crate::radiosity::{FormFactors, Patches, System};
use crate::report::words::{counted, percent};
use crate::report::{Cell, Findings, FoundTable, Table};
use crate::study::StudyError;
use crate::study::caster::{CastRecord, CasterChoice};

/// Form factors by the engine's rays, compared with those by the host's rays.
#[derive(Clone, Debug)]
pub(super) struct LeakRow {
    pub(super) cast: CastRecord,
    /// Sums of the absolute differences of a patch's form factors; light that moves between patches counts twice.
    pub(super) factors: ErrorSums,
    pub(super) error: SolutionError,
}

/// One row per Ray Engine caster; `first` holds the first caster's form factors. Empty if the first caster is the host.
pub(super) fn rows(
    parameters: &Parameters,
    patches: &Patches,
    first: &Room,
    progress: &mut ProgressFn<'_>,
) -> Result<Vec<LeakRow>, StudyError> {
    let Some(cast) = &first.cast else { return Ok(Vec::new()) };
    let solve = |factors: &FormFactors| -> Result<Vec<[f64; 3]>, StudyError> {
        let system = System::new(factors.clone(), patches.reflectances(), patches.emittances())?;
        Ok(system.solve(Solver::Direct, &parameters.options.stopping())?.radiosity())
    };
    let host = room(patches, parameters, &CasterChoice::Host, progress)?.factors;
    let (reference, emittance) = (solve(&host)?, patches.emittances());
    let row = |factors: &FormFactors, cast: CastRecord| -> Result<LeakRow, StudyError> {
        let mut off = ErrorSums::default();
        for (found, expected) in factors.matrix().rows().zip(host.matrix().rows()) {
            off.add(found.iter().zip(expected).map(|(found, expected)| (found - expected).abs()).sum(), 1.0);
        }
        let error = SolutionError::between(&solve(factors)?, &reference, &emittance);
        Ok(LeakRow { cast, factors: off, error })
    };
    let mut rows = vec![row(&first.factors, cast.clone())?];
    for caster in parameters.casters.iter().skip(1) {
        let Room { factors, cast, .. } = room(patches, parameters, caster, progress)?;
        rows.extend(cast.map(|cast| row(&factors, cast)).transpose()?);
    }
    Ok(rows)
}

const EXPLAINED: &str = "Each row recomputes the form factors with rays of the Ray Engine, on that card or in that \
    format. passes_s is the modelled time of the card's passes. differing counts rays whose hit differs from the exact \
    first hit: in the triangle, or in whether there is one. factors is the sum of the absolute changes of a patch's \
    form factors against those of the host's rays: its mean over the patches, and the largest. The last three \
    columns are errors of the direct solution, against the direct solution with the host's form factors: the largest error relative to the brightest patch; the largest \
    relative error of a patch that does not emit; and the signed mean of these relative errors.";

pub(super) fn report(rows: &[LeakRow], found: &mut Findings) {
    let columns = "rays_by rays on_card_% passes_s differing differing_% factors_% factors_largest_% largest_error \
         largest_relative mean_relative";
    let mut table = Table::of("Rays of the Ray Engine: what leaks into the room", columns);
    for LeakRow { cast, factors, error } in rows {
        let differing = cast.differing.unwrap_or(0);
        table.push([
            cast.label.as_str().into(),
            cast.counts.rays.into(),
            Cell::percent(100.0 * cast.counts.share_on_card()),
            cast.card.map_or(Cell::Empty, |time| Cell::measured(time.seconds())),
            differing.into(),
            Cell::percent(100.0 * differing as f64 / cast.counts.rays.max(1) as f64),
            Cell::percent(100.0 * factors.mean()),
            Cell::percent(100.0 * factors.largest),
            Cell::error(error.largest),
            Cell::error(error.relative_unlit),
            Cell::error(error.bias),
        ]);
    }
    let Some(worst) = rows.iter().max_by(|a, b| a.error.relative_unlit.total_cmp(&b.error.relative_unlit)) else {
        return;
    };
    found.conclusion(format!(
        "Of the rays that {} casts for form factors, {} from exact arithmetic; a patch is off by up to {}.",
        worst.cast.label,
        counted(worst.cast.differing.unwrap_or(0), "differs", "differ"),
        percent(worst.error.relative_unlit),
    ));
    found.heading("Form factors by the Ray Engine");
    found.explained_table(FoundTable::from(table).csv("casters").field("casters"), EXPLAINED);
}
