//! A unit of work of each system, timed as its rows are: for benches in modelled time.

use refsim::timing::Picoseconds;

use super::{StudyError, all_frequency, bi_scale, cpca, printed, radiosity, ray_engine, subsurface};

/// Work of a system with its modelled time.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedWork {
    /// Name of the printed figure, as in `radiosity/jacobi-rate`.
    pub figure: &'static str,
    /// Printed value with its unit and place.
    pub printed: String,
    /// Card.
    pub device: &'static str,
    /// Number of items, such as ray-triangle tests; 1 for a frame or a pass.
    pub items: u64,
    /// Modelled time of all items.
    pub time: Picoseconds,
}

impl TimedWork {
    pub(super) fn new(figure: &'static str, device: &'static str, time: Picoseconds) -> Result<Self, StudyError> {
        let found = printed(figure)?;
        let printed = format!("{} {} ({})", found.text(), found.unit, found.place);
        Ok(Self { figure, printed, device, items: 1, time })
    }
}

/// Times intersections of the Ray Engine's kernels, a Jacobi iteration, the three passes of subsurface scattering, and
/// frames of the systems of compressed transfer, with nothing drawn that the rows do not draw.
///
/// # Errors
/// If a card refuses the work.
pub fn timed() -> Result<Vec<TimedWork>, StudyError> {
    let mut all = ray_engine::radeon_8500::timed_tests()?;
    all.push(radiosity::timed()?);
    all.extend(subsurface::frames::timed()?);
    all.extend([cpca::timed()?, all_frequency::figures::timed()?, bi_scale::frames::timed()?]);
    Ok(all)
}
