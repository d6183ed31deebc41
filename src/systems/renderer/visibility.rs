//! Mutual visibility of points.

use super::counting::CountingCaster;
use crate::geom::Ray;
use crate::geom::vector::{narrow, wide};
use crate::tracer::{CastError, Caster};

/// Returns for each pair of points whether the open segment between them meets no triangle. The caller must offset
/// points on surfaces to the intended side; [`super::form_factor`] does so itself. Coincident points see each other,
/// and so do points whose direction f32 cannot represent. Fails with [`CastError`] if the caster fails.
pub fn visibility(pairs: &[[[f32; 3]; 2]], caster: &mut dyn Caster) -> Result<Vec<bool>, CastError> {
    let rays: Vec<Option<Ray>> = pairs.iter().map(|&[from, to]| segment(from, to)).collect();
    let mut ignore = |_| {};
    visible(&rays, &mut CountingCaster::new(caster, &mut ignore))
}

/// Like [`visibility`], for rays that end at t = 1; `None` counts as visible.
pub(super) fn visible(rays: &[Option<Ray>], tracer: &mut CountingCaster<'_>) -> Result<Vec<bool>, CastError> {
    let asked: Vec<Ray> = rays.iter().flatten().copied().collect();
    let mut occluded = tracer.occluded(&asked)?.into_iter();
    Ok(rays.iter().map(|ray| ray.is_none() || occluded.next() == Some(false)).collect())
}

fn segment(from: [f32; 3], to: [f32; 3]) -> Option<Ray> {
    Ray::new(from, narrow(wide(to) - wide(from))).ok()
}
