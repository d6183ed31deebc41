//! What the study finds.

use super::atlas::AtlasPictures;
use super::change::Relit;
use super::difference::SolutionError;
use super::method::{SolveMethod, StopReason};
use super::pictures::{IterationPicture, Pictures};
use super::sweep::SweepRow;
use super::time::CardFacts;
use crate::radiosity::Patches;
use crate::radiosity::form_factor::RowSums;

/// One method, and what came of it.
#[derive(Debug)]
pub struct MethodRow {
    /// The method.
    pub way: SolveMethod,
    /// Its name, unique in a study and fit for a file name.
    pub label: String,
    /// The radiosity of each patch.
    pub radiosity: Vec<[f64; 3]>,
    /// Figure 3's error at the start and after each iteration: the mean squared residual, over all channels.
    pub history: Vec<f64>,
    /// The final residual relative to the emittance, both by their Euclidean norms.
    pub residual: f64,
    /// Why it stopped.
    pub stopped: StopReason,
    /// Energy-balance error relative to the emitted power, the largest of the channels.
    pub energy_balance_error: f64,
    /// The difference from the direct solution, if that was asked for.
    pub off: Option<SolutionError>,
    /// On a card.
    pub card: Option<CardFacts>,
    /// After the changes.
    pub relit: Option<Relit>,
    /// How the room looks.
    pub pictures: Pictures,
}

/// All solutions.
#[derive(Debug)]
pub struct RadiosityOutcome {
    /// The patches.
    pub patches: Patches,
    /// Row sums before anything was enforced.
    pub found_sums: RowSums,
    /// The largest relative difference between A_i F_ij and A_j F_ji, before anything was enforced.
    pub reciprocity_error: f64,
    /// Pictures' exposure.
    pub exposure: f64,
    /// A row per method.
    pub rows: Vec<MethodRow>,
    /// The room after some iterations.
    pub frames: Vec<IterationPicture>,
    /// The direct solution, or the first method's, in a meshed atlas, if one was asked for.
    pub atlas: Option<AtlasPictures>,
    /// Other numbers of patches, other settings of the switches.
    pub sweep: Vec<SweepRow>,
}
