//! Bidirectional textures of heights by plain loops: every cell that a ray could touch is asked.

use super::field::HeightField;
use super::patch::{MesoPatch, SeenPoint};
use super::ray::{SurfaceHit, TexelRay};
use glam::DVec3;

/// The cells below the box around a ray, and one more on each side.
fn cells_below(ray: &TexelRay) -> Vec<[isize; 2]> {
    let (begin, end) = (ray.at, ray.place(ray.end));
    let range = |axis: usize| {
        let low = begin[axis].min(end[axis]).floor() as isize - 1;
        let high = begin[axis].max(end[axis]).floor() as isize + 1;
        low..=high
    };
    let mut cells = Vec::new();
    for row in range(1) {
        for column in range(0) {
            cells.push([column, row]);
        }
    }
    cells
}

/// The nearest hit among all cells.
pub(super) fn first_hit(field: &HeightField, ray: &TexelRay) -> Option<SurfaceHit> {
    let mut nearest: Option<(f64, SurfaceHit)> = None;
    for cell in cells_below(ray) {
        let Some(span) = ray.span(cell) else { continue };
        let Some(hit) = ray.hit(field, &span) else { continue };
        // On a line between two cells the one that the ray comes from counts.
        if nearest.is_none_or(|(from, before)| (hit.t, span.from) < (before.t, from)) {
            nearest = Some((span.from, hit));
        }
    }
    nearest.map(|(_, hit)| hit)
}

/// Whether a ray comes below the surface of any cell.
pub(super) fn is_blocked(field: &HeightField, ray: &TexelRay) -> bool {
    let mut blocked = false;
    for cell in cells_below(ray) {
        if let Some(span) = ray.span(cell) {
            blocked |= ray.dips(field, &span);
        }
    }
    blocked
}

/// What is seen through a place of the reference plane, every cell asked.
pub fn seen(patch: &MesoPatch, place: [f64; 2], view: DVec3) -> SeenPoint {
    patch.seen_by(place, view, first_hit)
}

/// b(u, e, d), every cell asked: the response at a place towards a view from a light.
pub fn response(patch: &MesoPatch, place: [f64; 2], view: DVec3, light: DVec3) -> [f64; 3] {
    patch.reflected_by(&seen(patch, place, view), light, is_blocked)
}
