//! Bidirectional textures of height fields by plain loops over every cell that a ray could touch.

use super::field::HeightField;
use super::patch::{MesoPatch, SeenPoint};
use super::ray::{SurfaceHit, TexelRay};
use glam::DVec3;

/// The cells under the bounding box of a ray, and one more cell on each side.
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

pub(super) fn first_hit(field: &HeightField, ray: &TexelRay) -> Option<SurfaceHit> {
    let mut nearest: Option<(f64, SurfaceHit)> = None;
    for cell in cells_below(ray) {
        let Some(span) = ray.span(cell) else { continue };
        let Some(hit) = ray.hit(field, &span) else { continue };
        // For a hit on the border of two cells, the cell that the ray leaves is taken.
        if nearest.is_none_or(|(from, before)| (hit.t, span.from) < (before.t, from)) {
            nearest = Some((span.from, hit));
        }
    }
    nearest.map(|(_, hit)| hit)
}

pub(super) fn is_blocked(field: &HeightField, ray: &TexelRay) -> bool {
    let mut blocked = false;
    for cell in cells_below(ray) {
        if let Some(span) = ray.span(cell) {
            blocked |= ray.dips(field, &span);
        }
    }
    blocked
}

/// The point that a view sees through a position of the reference plane, with a test of every cell.
pub fn seen(patch: &MesoPatch, place: [f64; 2], view: DVec3) -> SeenPoint {
    patch.seen_by(place, view, first_hit)
}

/// b(u, e, d) with a test of every cell: the response at a position for a view and a light direction.
pub fn response(patch: &MesoPatch, place: [f64; 2], view: DVec3, light: DVec3) -> [f64; 3] {
    patch.reflected_by(&seen(patch, place, view), light, is_blocked)
}
