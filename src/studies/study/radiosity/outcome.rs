//! Results of the study.

use super::leaks::LeakRow;
use super::method::{SolveMethod, StopReason};
use super::pictures::{IterationPicture, Pictures};
use super::solve::SolutionError;
use super::sweep::SweepRow;
use super::time::CardFacts;
use crate::radiosity::Patches;
use crate::radiosity::form_factor::RowSums;

#[derive(Debug)]
pub(super) struct MethodRow {
    pub(super) method: SolveMethod,
    /// Name of the method, unique in a study and valid as a file name.
    pub(super) label: String,
    pub(super) radiosity: Vec<[f64; 3]>,
    /// Figure 3's error, initially and after each iteration: the mean squared residual over all channels.
    pub(super) history: Vec<f64>,
    /// Final residual relative to the emittance, both in Euclidean norms.
    pub(super) residual: f64,
    pub(super) stopped: StopReason,
    /// Error of the energy balance, relative to the emitted power; the maximum over the channels.
    pub(super) energy_balance_error: f64,
    /// Error compared with the direct solution, if that was requested.
    pub(super) error: Option<SolutionError>,
    /// `None` for solvers of the host.
    pub(super) card: Option<CardFacts>,
    pub(super) pictures: Pictures,
}

impl MethodRow {
    pub(super) fn iterations(&self) -> usize {
        self.history.len().saturating_sub(1)
    }
}

#[derive(Debug)]
pub(super) struct RadiosityOutcome {
    pub(super) patches: Patches,
    /// Row sums before closure was enforced.
    pub(super) found_sums: RowSums,
    pub(super) leaks: Vec<LeakRow>,
    /// Pixel value per unit of radiance.
    pub(super) exposure: f64,
    pub(super) rows: Vec<MethodRow>,
    pub(super) frames: Vec<IterationPicture>,
    pub(super) sweep: Vec<SweepRow>,
}
