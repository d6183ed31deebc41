//! What the study found.

use super::model::ModelLengths;
use super::roundings::RoundingRow;
use super::truth::Truth;
use super::way::WayRow;
use crate::atlas::Atlas;
use crate::subsurface::Dipole;

/// What a study found.
#[derive(Debug)]
pub struct SubsurfaceOutcome {
    /// The model's atlas.
    pub atlas: Atlas,
    /// Lengths of model and medium.
    pub lengths: ModelLengths,
    /// Of red, green and blue.
    pub dipoles: [Dipole; 3],
    /// E of equation 8 per texel, by the host.
    pub irradiance: Vec<[f64; 3]>,
    /// All pairs, if asked for.
    pub truth: Option<Truth>,
    /// For each probe its texel.
    pub probe_texels: Vec<usize>,
    /// A row per way.
    pub rows: Vec<WayRow>,
    /// Other values of the card's rounding switches, if asked for.
    pub roundings: Vec<RoundingRow>,
}
