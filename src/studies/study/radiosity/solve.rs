//! Solution by one method: a solver of the host, or equation 4 on the card.

use super::change::Relit;
use super::method::{CardMethod, SolveMethod, StopReason};
use super::no_card;
use super::parameters::Parameters;
use crate::card::CardError;
use crate::radiosity::System;
use crate::radiosity::on_card::{CardOptions, CardSolution, CardSolver, to_f64};
use crate::radiosity::solve::{Options, Solver, mean_square};
use crate::study::StudyError;

/// Solution by a method, with its card.
pub(super) struct Solved {
    pub(super) method: SolveMethod,
    pub(super) radiosity: Vec<[f64; 3]>,
    pub(super) history: Vec<f64>,
    /// Initial residual, for normalising.
    pub(super) emitted: f64,
    pub(super) stopped: StopReason,
    pub(super) relit: Option<Relit>,
    pub(super) card: Option<CardSolver>,
    /// Radiosities after the iterations requested by `--picture-after`.
    pub(super) recorded: Vec<(u32, Vec<[f64; 3]>)>,
}

/// Mean squared emittance, over all channels.
fn emitted(system: &System) -> f64 {
    mean([0, 1, 2].map(|c| mean_square(&system.right_hand_side(c))))
}

fn mean([r, g, b]: [f64; 3]) -> f64 {
    (r + g + b) / 3.0
}

/// Solves, and solves again after the changes.
pub(super) fn solve(
    method: SolveMethod,
    system: &System,
    changed: Option<&System>,
    parameters: &Parameters,
) -> Result<Solved, StudyError> {
    match method {
        SolveMethod::Host(solver) => on_host(solver, system, changed, &parameters.options.stopping()),
        SolveMethod::Card(how) => on_card(how, system, changed, parameters).map_err(no_card),
    }
}

fn on_host(solver: Solver, system: &System, changed: Option<&System>, options: &Options) -> Result<Solved, StudyError> {
    let found = system.solve(solver, options, None)?;
    let radiosity = found.radiosity();
    let relit = changed.map(|changed| -> Result<Relit, StudyError> {
        let again = changed.solve(solver, options, Some(&radiosity))?;
        let anew = changed.solve(solver, options, None)?;
        let count = |s: &crate::radiosity::RgbSolution| {
            let all = s.channels.iter().all(|c| c.converged);
            all.then(|| s.channels.iter().map(crate::radiosity::solve::Solution::iterations).max().unwrap_or(0))
        };
        Ok(Relit { from_last: count(&again), from_nothing: count(&anew), radiosity: again.radiosity() })
    });
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
        relit: relit.transpose()?,
        radiosity,
        card: None,
        recorded: Vec::new(),
    })
}

fn on_card(
    how: CardMethod,
    system: &System,
    changed: Option<&System>,
    parameters: &Parameters,
) -> Result<Solved, CardError> {
    let executor = parameters.executor.clone();
    let mut card = CardSolver::new(parameters.profile.clone(), executor, system, how.packing, how.storage)?;
    let Options { tolerance, most_iterations } = parameters.options.stopping();
    let options = CardOptions { tolerance, most_iterations, check_every: 1 };
    let mut recorded = Vec::new();
    let found = card.solve(system, &options, &mut |at| {
        if parameters.options.frames.contains(&at.number) {
            recorded.push((at.number, to_f64(at.radiosity)));
        }
    })?;
    let radiosity = to_f64(&found.radiosity);
    let relit = changed.map(|changed| -> Result<Relit, CardError> {
        let mut run = |start: &[[f32; 3]]| {
            card.load(start)?;
            card.set_system(changed)?;
            card.solve(changed, &options, &mut |_| ())
        };
        let again = run(&found.radiosity)?;
        let anew = run(&vec![[0.0; 3]; found.radiosity.len()])?;
        // Restores the first solution, which the card displays later.
        card.load(&found.radiosity)?;
        card.set_system(system)?;
        let count = |s: &CardSolution| s.converged.then(|| s.iterations() as usize);
        Ok(Relit { from_last: count(&again), from_nothing: count(&anew), radiosity: to_f64(&again.radiosity) })
    });
    let relit = relit.transpose()?;
    Ok(Solved {
        method: SolveMethod::Card(how),
        radiosity,
        history: found.history.iter().map(|(_, residual)| mean(*residual)).collect(),
        emitted: emitted(system),
        stopped: StopReason::on_card(&found),
        relit,
        card: Some(card),
        recorded,
    })
}
