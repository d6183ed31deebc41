//! Do two points see each other?

use super::counting::{CountingCaster, RayCounts};
use crate::geom::Ray;
use crate::geom::vector::{narrow, wide};
use crate::tracer::{CastError, Caster};

/// For each pair of points: whether the open segment between them meets no triangle. Points on surfaces must be lifted
/// off them by the caller, to the side that is meant; [`super::form_factor`] does so by itself. Two points at one place
/// see each other, and so do points that f32 has no segment for.
///
/// # Errors
/// [`CastError`] if the caster fails.
pub fn visibility(pairs: &[[[f32; 3]; 2]], caster: &mut dyn Caster) -> Result<Vec<bool>, CastError> {
    let rays: Vec<Option<Ray>> = pairs.iter().map(|&[from, to]| segment(from, to)).collect();
    let mut ignore = |_| {};
    visible(&rays, &mut CountingCaster::new(caster, &mut ignore)).map(|(seen, _)| seen)
}

/// The same for rays that end at t = 1; no ray sees everything.
pub(super) fn visible(
    rays: &[Option<Ray>],
    tracer: &mut CountingCaster<'_>,
) -> Result<(Vec<bool>, RayCounts), CastError> {
    let asked: Vec<Ray> = rays.iter().flatten().copied().collect();
    let mut occluded = tracer.occluded(&asked)?.into_iter();
    let seen = rays.iter().map(|ray| ray.is_none() || occluded.next() == Some(false)).collect();
    Ok((seen, tracer.counts))
}

fn segment(from: [f32; 3], to: [f32; 3]) -> Option<Ray> {
    Ray::new(from, narrow(wide(to) - wide(from))).ok()
}
