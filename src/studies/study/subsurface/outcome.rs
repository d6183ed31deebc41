//! Results of the study.

use super::model::ModelLengths;
use super::way::WayRow;
use crate::atlas::Atlas;
use crate::study::caster::CastRecord;
use crate::subsurface::Dipole;

#[derive(Debug)]
pub(super) struct SubsurfaceOutcome {
    pub(super) atlas: Atlas,
    pub(super) lengths: ModelLengths,
    /// Dipoles for red, green and blue.
    pub(super) dipoles: [Dipole; 3],
    /// E of equation 8 per texel, computed by the host.
    pub(super) irradiance: Vec<[f64; 3]>,
    pub(super) cast: Option<CastRecord>,
    /// Radiosities over all pairs, in f64, per texel, row by row; `None` if not requested.
    pub(super) truth: Option<Vec<[f64; 3]>>,
    pub(super) rows: Vec<WayRow>,
}

impl SubsurfaceOutcome {
    /// Values per texel by name: E, B over all pairs if computed, and B by every way of gathering.
    pub(super) fn columns(&self) -> impl Iterator<Item = (&str, &[[f64; 3]])> {
        let truth = self.truth.iter().map(|truth| ("all_pairs", &truth[..]));
        let ways = self.rows.iter().map(|row| (row.label.as_str(), &row.radiosity[..]));
        [("E", &self.irradiance[..])].into_iter().chain(truth).chain(ways)
    }
}
