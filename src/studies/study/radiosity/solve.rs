//! Form factors of the patches; the solution by one method, a solver of the host or equation 4 on the card; its error
//! compared with the direct solution.

use super::method::{CardMethod, SolveMethod, StopReason};
use super::{Factors, Parameters, ProgressFn, no_card};
use crate::card::CardError;
use crate::geom::exact::Sides;
use crate::picture::metrics::{ErrorSums, value_error};
use crate::radiosity::form_factor::RowSums;
use crate::radiosity::on_card::{CardSolver, to_f64};
use crate::radiosity::solve::{Options, Solver, mean_square};
use crate::radiosity::{FormFactors, Patches, System};
use crate::study::StudyError;
use crate::study::caster::{CastRecord, CasterChoice};

/// Form factors, with their row sums before closure was enforced.
pub(super) struct Room {
    pub(super) factors: FormFactors,
    pub(super) found_sums: RowSums,
    /// Statistics of the Ray Engine, if it cast the rays.
    pub(super) cast: Option<CastRecord>,
}

pub(super) fn room(
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

pub(super) struct Solved {
    pub(super) method: SolveMethod,
    pub(super) radiosity: Vec<[f64; 3]>,
    pub(super) history: Vec<f64>,
    /// Initial residual, for normalising.
    pub(super) emitted: f64,
    pub(super) stopped: StopReason,
    pub(super) card: Option<CardSolver>,
    /// Radiosities after the iterations requested by `--picture-after`.
    pub(super) recorded: Vec<(u32, Vec<[f64; 3]>)>,
}

fn emitted(system: &System) -> f64 {
    mean([0, 1, 2].map(|c| mean_square(&system.right_hand_side(c))))
}

fn mean([r, g, b]: [f64; 3]) -> f64 {
    (r + g + b) / 3.0
}

pub(super) fn solve(method: SolveMethod, system: &System, parameters: &Parameters) -> Result<Solved, StudyError> {
    match method {
        SolveMethod::Host(solver) => on_host(solver, system, &parameters.options.stopping()),
        SolveMethod::Card(how) => on_card(how, system, parameters).map_err(no_card),
    }
}

fn on_host(solver: Solver, system: &System, options: &Options) -> Result<Solved, StudyError> {
    let found = system.solve(solver, options)?;
    let radiosity = found.radiosity();
    // Channels stop independently; a stopped channel keeps its last residual.
    let longest = found.channels.iter().map(|c| c.history.len()).max().unwrap_or(0);
    let at = |k: usize| [0, 1, 2].map(|c| found.channels[c].history[k.min(found.channels[c].history.len() - 1)]);
    let converged = found.channels.iter().all(|c| c.converged);
    Ok(Solved {
        method: SolveMethod::Host(solver),
        history: (0..longest).map(|k| mean(at(k))).collect(),
        emitted: emitted(system),
        stopped: match (solver, converged) {
            (Solver::Direct, _) => StopReason::Direct,
            (_, true) => StopReason::Tolerance,
            (_, false) => StopReason::Iterations,
        },
        radiosity,
        card: None,
        recorded: Vec::new(),
    })
}

fn on_card(how: CardMethod, system: &System, parameters: &Parameters) -> Result<Solved, CardError> {
    let executor = parameters.executor.clone();
    let mut card = CardSolver::new(parameters.profile.clone(), executor, system, how.packing, how.storage)?;
    let options = parameters.options.stopping();
    let mut recorded = Vec::new();
    let found = card.solve(system, &options, &mut |at| {
        if parameters.options.frames.contains(&at.number) {
            recorded.push((at.number, to_f64(at.radiosity)));
        }
    })?;
    let radiosity = to_f64(&found.radiosity);
    Ok(Solved {
        method: SolveMethod::Card(how),
        radiosity,
        history: found.history.iter().map(|(_, residual)| mean(*residual)).collect(),
        emitted: emitted(system),
        stopped: StopReason::on_card(&found),
        card: Some(card),
        recorded,
    })
}

/// Error over all patches and channels; infinite where only one of two radiosities is finite.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::study) struct SolutionError {
    /// Largest absolute difference, relative to the brightest patch's radiosity.
    pub(in crate::study) largest: f64,
    /// Largest relative difference. Patches without any light are excluded.
    pub(in crate::study) relative: f64,
    /// Largest relative difference over patches that do not emit.
    pub(in crate::study) relative_unlit: f64,
    /// Signed mean relative difference over patches that do not emit: negative if they are too dark.
    pub(in crate::study) bias: f64,
    /// Number of radiosities that are not finite where the direct ones are, or the reverse.
    pub(in crate::study) not_finite: u64,
}

impl SolutionError {
    pub(in crate::study) fn between(found: &[[f64; 3]], reference: &[[f64; 3]], emittance: &[[f64; 3]]) -> Self {
        let brightest = reference.as_flattened().iter().copied().filter(|b| b.is_finite()).fold(0.0, f64::max);
        let [mut absolute, mut relative, mut unlit] = [ErrorSums::default(); 3];
        for ((found, reference), emittance) in found.iter().zip(reference).zip(emittance) {
            for c in 0..3 {
                let difference = value_error(found[c], reference[c]);
                absolute.add(difference, 1.0);
                if reference[c] > 0.0 {
                    let share = if difference.is_finite() { difference / reference[c] } else { difference };
                    relative.add(share, 1.0);
                    if emittance[c] == 0.0 {
                        unlit.add(share, 1.0);
                    }
                }
            }
        }
        Self {
            largest: if absolute.largest > 0.0 { absolute.largest / brightest } else { 0.0 },
            relative: relative.largest,
            relative_unlit: unlit.largest,
            bias: unlit.mean(),
            not_finite: absolute.not_finite,
        }
    }
}
