//! Results of the study.

use super::difference::SolutionError;
use super::leaks::LeakRow;
use super::method::{SolveMethod, StopReason};
use super::pictures::{IterationPicture, Pictures};
use super::sweep::SweepRow;
use super::time::CardFacts;
use crate::radiosity::Patches;
use crate::radiosity::form_factor::RowSums;

/// Results of one method.
#[derive(Debug)]
pub(super) struct MethodRow {
    pub(super) method: SolveMethod,
    /// Name of the method, unique in a study and valid as a file name.
    pub(super) label: String,
    /// Radiosity of each patch.
    pub(super) radiosity: Vec<[f64; 3]>,
    /// Figure 3's error, initially and after each iteration: the mean squared residual over all channels.
    pub(super) history: Vec<f64>,
    /// Final residual relative to the emittance, both in Euclidean norms.
    pub(super) residual: f64,
    /// Reason why it stopped.
    pub(super) stopped: StopReason,
    /// Energy-balance error relative to the emitted power; the maximum over the channels.
    pub(super) energy_balance_error: f64,
    /// Error compared with the direct solution, if that was requested.
    pub(super) error: Option<SolutionError>,
    /// Cost on a card; `None` on the host.
    pub(super) card: Option<CardFacts>,
    /// Pictures of the room.
    pub(super) pictures: Pictures,
}

/// Results of all methods.
#[derive(Debug)]
pub(super) struct RadiosityOutcome {
    pub(super) patches: Patches,
    /// Row sums before closure was enforced.
    pub(super) found_sums: RowSums,
    /// Form factors by rays of the Ray Engine, one row per engine.
    pub(super) leaks: Vec<LeakRow>,
    /// Exposure of the pictures: pixel value per unit of radiance.
    pub(super) exposure: f64,
    /// One row per method.
    pub(super) rows: Vec<MethodRow>,
    /// Pictures of the room after some iterations.
    pub(super) frames: Vec<IterationPicture>,
    /// Rows of the sweep over numbers of patches and settings of the switches.
    pub(super) sweep: Vec<SweepRow>,
}
