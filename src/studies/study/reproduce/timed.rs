//! A unit of work of each system, timed as in its rows: for benches in modelled time.

use super::{StudyError, TimedWork, all_frequency, bi_scale, cpca, radiosity, ray_engine, subsurface};

/// Times intersections of the Ray Engine's kernels, a Jacobi iteration, the three passes of subsurface scattering, and
/// frames of the systems of compressed transfer. Draws nothing that the rows do not draw. Fails if a card rejects the
/// work.
pub fn timed() -> Result<Vec<TimedWork>, StudyError> {
    let mut all = ray_engine::radeon_8500::timed_tests()?;
    all.push(radiosity::timed()?);
    all.extend(subsurface::frames::timed()?);
    all.extend([cpca::timed()?, all_frequency::figures::timed()?, bi_scale::frames::timed()?]);
    Ok(all)
}
