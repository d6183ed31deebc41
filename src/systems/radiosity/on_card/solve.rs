//! Iteration until the residual is small enough. The host computes the residual in f64 from the radiosities read back.

use super::cycle::StateDigests;
use super::{CardError, CardSolver, Cycle};
use crate::radiosity::System;
use crate::radiosity::solve::{Options, mean_square};

/// The state of an iteration.
#[derive(Clone, Copy, Debug)]
pub struct Iteration<'a> {
    /// Iterations done; 0 is the initial state.
    pub number: u32,
    /// The mean square of the residual in each channel: Figure 3's error.
    pub residual: [f64; 3],
    /// The radiosities.
    pub radiosity: &'a [[f32; 3]],
}

/// A solution with its convergence history.
#[derive(Clone, Debug, PartialEq)]
pub struct CardSolution {
    /// Red, green and blue of each patch.
    pub radiosity: Vec<[f32; 3]>,
    /// Iterations after which the residual was computed (0: initially), with its mean square in each channel.
    pub history: Vec<(u32, [f64; 3])>,
    /// `true` if the tolerance was reached.
    pub converged: bool,
    /// The cycle or fixed point in which the radiosities ended without reaching the tolerance.
    pub cycle: Option<Cycle>,
}

impl CardSolution {
    /// Number of iterations done.
    pub fn iterations(&self) -> u32 {
        self.history.last().map_or(0, |last| last.0)
    }
}

impl CardSolver {
    /// Iterates from the radiosities on the card until every channel's residual is small enough, or a state repeats bit
    /// for bit. `system` is the system on the card before rounding; `each` is called whenever the residual is computed.
    /// Fails with [`CardError::Input`] if the system has another number of patches, or the iteration diverges; with
    /// [`CardError::Draw`] if the card rejects a draw. Reaching the maximum number of iterations is not an error: see
    /// [`CardSolution::converged`].
    pub fn solve(
        &mut self,
        system: &System,
        options: &Options,
        each: &mut dyn FnMut(&Iteration<'_>),
    ) -> Result<CardSolution, CardError> {
        CardError::check_size(super::PATCHES, self.patches(), system.factors().len())?;
        let channels = [0, 1, 2];
        let target = channels.map(|c| options.tolerance * options.tolerance * mean_square(&system.right_hand_side(c)));
        let (mut history, mut number) = (Vec::new(), 0);
        let mut radiosity = self.read()?;
        let mut seen = StateDigests::default();
        loop {
            let residual = system.residual(&to_f64(&radiosity));
            if residual.iter().any(|r| !r.is_finite()) {
                return Err(CardError::input(format!(
                    "expected an iteration that converges, found no finite residual after {number} iterations"
                )));
            }
            history.push((number, residual));
            each(&Iteration { number, residual, radiosity: &radiosity });
            let converged = channels.iter().all(|&c| residual[c] <= target[c]);
            // A repeated digest may be a collision; only states that repeat bit for bit are a cycle.
            let cycle = match seen.note(&radiosity, number) {
                Some(first) if !converged => self.around(&radiosity, first, number - first)?,
                _ => None,
            };
            if converged || cycle.is_some() || number >= options.most_iterations {
                return Ok(CardSolution { radiosity, history, converged, cycle });
            }
            self.iterate()?;
            number += 1;
            radiosity = self.read()?;
        }
    }
}

/// Converts radiosities read back from a card to the type of the host's solvers.
pub fn to_f64(radiosity: &[[f32; 3]]) -> Vec<[f64; 3]> {
    radiosity.iter().map(|b| b.map(f64::from)).collect()
}
