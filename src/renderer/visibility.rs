//! Do two points see each other?

use super::surfel::blocked;
use super::tracer::{Kind, RayCounts, Tracer};
use crate::geom::vector::{narrow, wide};
use crate::geom::{CastError, Caster, Ray};

/// For each pair of points: whether the open segment between them meets no triangle. Points on surfaces must be lifted off them by the
/// caller, to the side that is meant; [`super::form_factor`] does so by itself. Two points at one place see each other, and so do points that
/// f32 has no segment for.
///
/// # Errors
/// [`CastError`] if the caster fails.
pub fn visibility(pairs: &[[[f32; 3]; 2]], caster: &mut dyn Caster) -> Result<Vec<bool>, CastError> {
    let rays: Vec<Option<Ray>> = pairs.iter().map(|&[from, to]| segment(from, to)).collect();
    let mut ignore = |_| {};
    visible(&rays, &mut Tracer::new(caster, &mut ignore)).map(|(seen, _)| seen)
}

/// The same for rays that end at t = 1; no ray sees everything.
pub(super) fn visible(rays: &[Option<Ray>], tracer: &mut Tracer<'_>) -> Result<(Vec<bool>, RayCounts), CastError> {
    let asked: Vec<Ray> = rays.iter().flatten().copied().collect();
    let mut hits = tracer.cast(&asked, |_| Kind::Shadow)?.into_iter();
    let seen = rays.iter().map(|ray| ray.is_none() || !blocked(hits.next().flatten())).collect();
    Ok((seen, tracer.counts))
}

fn segment(from: [f32; 3], to: [f32; 3]) -> Option<Ray> {
    Ray::new(from, narrow(wide(to) - wide(from))).ok()
}
