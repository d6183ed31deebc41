//! Results of the study.

use super::all_pairs::AllPairs;
use super::model::ModelLengths;
use super::roundings::RoundingRow;
use super::walk::WalkedChannel;
use super::way::WayRow;
use crate::atlas::Atlas;
use crate::subsurface::Dipole;

/// Results of a study.
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
    pub truth: Option<AllPairs>,
    /// Photons that walked, per channel, if asked for; `None` for a channel without light.
    pub walked: Option<[Option<WalkedChannel>; 3]>,
    /// A row per way.
    pub rows: Vec<WayRow>,
    /// Other values of the card's rounding switches, if asked for.
    pub roundings: Vec<RoundingRow>,
}

impl SubsurfaceOutcome {
    /// Values per texel by name: E, B over all pairs if there, and B of every way.
    pub(super) fn columns(&self) -> impl Iterator<Item = (&str, &[[f64; 3]])> {
        let truth = self.truth.iter().map(|truth| ("all_pairs", &truth.texels[..]));
        let ways = self.rows.iter().map(|row| (row.label.as_str(), &row.radiosity[..]));
        [("E", &self.irradiance[..])].into_iter().chain(truth).chain(ways)
    }
}
