//! Iterations until the residual is small enough; the residual is the host's, in f64, from what it reads back.

use super::cycle::Seen;
use super::{CardError, CardSolver, Cycle};
use crate::radiosity::System;
use crate::radiosity::solve::mean_square;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CardOptions {
    /// The residual's length as a share of the right side's, in each channel.
    pub tolerance: f64,
    /// The most iterations.
    pub most_iterations: u32,
    /// Iterations from one look at the residual to the next, which costs a read-back; at least 1.
    pub check_every: u32,
}

impl Default for CardOptions {
    fn default() -> Self {
        Self { tolerance: 1e-6, most_iterations: 1000, check_every: 1 }
    }
}

/// Where a solution stands.
#[derive(Clone, Copy, Debug)]
pub struct Iteration<'a> {
    /// Iterations done; 0 is the start.
    pub number: u32,
    /// The mean square of the residual in each channel: Figure 3's error.
    pub residual: [f64; 3],
    /// The radiosities.
    pub radiosity: &'a [[f32; 3]],
}

/// A solution, and how it was reached.
#[derive(Clone, Debug, PartialEq)]
pub struct CardSolution {
    /// Red, green and blue of each patch.
    pub radiosity: Vec<[f32; 3]>,
    /// The iterations after which the residual was looked at, the start among them, and its mean square in each channel.
    pub history: Vec<(u32, [f64; 3])>,
    /// Whether the tolerance was reached.
    pub converged: bool,
    /// The cycle that the radiosities go round in for ever, or the fixed point at which they stay: why it ended without
    /// the tolerance. `None` if it ended before one was found.
    pub cycle: Option<Cycle>,
}

impl CardSolution {
    /// How many iterations it took.
    #[must_use]
    pub fn iterations(&self) -> u32 {
        self.history.last().map_or(0, |last| last.0)
    }
}

impl CardSolver {
    /// Iterates from the radiosities on the card until every channel's residual is small enough, or a state that was
    /// looked at comes back to the bit. `system` is what is on the card before it was rounded; `each` is told whenever
    /// the residual is looked at.
    ///
    /// # Errors
    /// [`CardError::Size`] if the system has another number of patches, [`CardError::Diverged`], [`CardError::Machine`]. Reaching the
    /// most iterations is none: [`CardSolution::converged`] tells.
    pub fn solve(
        &mut self,
        system: &System,
        options: &CardOptions,
        each: &mut dyn FnMut(&Iteration<'_>),
    ) -> Result<CardSolution, CardError> {
        super::same(super::PATCHES, self.len(), system.factors().len())?;
        let channels = [0, 1, 2];
        let target = channels.map(|c| options.tolerance * options.tolerance * mean_square(&system.right(c)));
        let (mut history, mut number) = (Vec::new(), 0);
        let mut radiosity = self.read()?;
        let mut seen = Seen::default();
        loop {
            let residual = system.residual(&widened(&radiosity));
            if residual.iter().any(|r| !r.is_finite()) {
                return Err(CardError::Diverged { iterations: number });
            }
            history.push((number, residual));
            each(&Iteration { number, residual, radiosity: &radiosity });
            let converged = channels.iter().all(|&c| residual[c] <= target[c]);
            let cycle = match seen.note(&radiosity, number) {
                Some(first) if !converged => self.around(&radiosity, [first, number - first])?,
                _ => None,
            };
            if converged || cycle.is_some() || number >= options.most_iterations {
                return Ok(CardSolution { radiosity, history, converged, cycle });
            }
            let steps = options.check_every.max(1).min(options.most_iterations - number);
            for _ in 0..steps {
                self.iterate()?;
            }
            number += steps;
            radiosity = self.read()?;
        }
    }
}

fn widened(radiosity: &[[f32; 3]]) -> Vec<[f64; 3]> {
    radiosity.iter().map(|b| b.map(f64::from)).collect()
}
