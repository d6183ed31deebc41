//! The parts of patches that no solid covers.
//!
//! The floor under a block receives no light and is never visible. If it were included, the mean radiosity of a partly
//! covered patch would be too low, or, after its row of form factors is scaled to 1, its area and so its power would be
//! too large. A patch is therefore represented by its open parts.
//!
//! The rule, applied to each face's plane raised by [`scene_clearance`] towards its front, where visibility rays start:
//!
//! 1. Triangles of other faces that cross the raised plane leave line segments in it, which cut the patches into convex
//!    cells.
//! 2. A cell is covered, that is, inside a solid, if from several of its points the first surface in each of 25
//!    directions is seen from behind.
//! 3. All other cells are open, including doubtful cases: a sheet close above the patch, solids that overlap.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::patch::Patch;
use crate::geom::exact::{Sides, Tracer};
use crate::geom::polygon::clipped;
use crate::geom::vector::{narrow, unit, wide};
use crate::geom::{Mesh, Ray};
use crate::tracer::offset::scene_clearance;

/// Minimum length of a cut, and minimum distance from a cell's border, in multiples of the lift.
const FINEST: f64 = 4.0;
/// Maximum number of cells per patch; beyond it, cells are not cut further.
const MAX_CELLS: usize = 4096;
/// Position of test points between a cell's centre (0) and its corners (1).
const OUTWARDS: f64 = 0.75;
/// Tangents of the tested directions along the plane's two axes; 0, the normal, is first.
const TANGENTS: [f64; 5] = [0.0, -2.0, -1.0, 1.0, 2.0];

/// A line segment in a raised plane.
type PlaneSegment = [DVec3; 2];

/// Returns the open parts of each patch that is not wholly open; an empty list for a wholly covered patch.
pub(super) fn open_parts(list: &[Patch], mesh: &Mesh, face_of: &[u32], extent: f64) -> BTreeMap<u32, Vec<Patch>> {
    let triangles: Vec<[DVec3; 3]> = mesh.iter_corners().map(|t| t.map(wide)).collect();
    let lift = scene_clearance(extent);
    let mut faces: BTreeMap<u32, Vec<PlaneSegment>> = BTreeMap::new();
    for patch in list {
        faces.entry(patch.face).or_insert_with(|| {
            let others = triangles.iter().zip(face_of).filter(|&(_, &face)| face != patch.face);
            others.filter_map(|(triangle, _)| crossing_segment(patch, lift, triangle)).collect()
        });
    }
    let tracer = Tracer::new(mesh);
    let parts = |(i, patch): (usize, &Patch)| {
        let mut cells = Vec::new();
        cut(patch.corners().to_vec(), patch.normal(), &faces[&patch.face], FINEST * lift, &mut cells);
        let all = cells.len();
        cells.retain(|cell| !is_covered(cell, patch, lift, mesh, &tracer));
        (cells.len() < all)
            .then(|| (i as u32, cells.iter().flat_map(|cell| pieces(cell, patch)).collect::<Vec<Patch>>()))
    };
    list.par_iter().enumerate().filter_map(parts).collect()
}

/// A convex polygon in the patch's plane, counter-clockwise from its front.
type ConvexCell = Vec<DVec3>;

/// Returns the segment in which a triangle crosses a patch's plane raised by `lift`.
fn crossing_segment(patch: &Patch, lift: f64, triangle: &[DVec3; 3]) -> Option<PlaneSegment> {
    let heights = triangle.map(|corner| patch.height(corner) - lift);
    let crossing = |k: usize| {
        let (from, to) = (k, (k + 1) % 3);
        let (h, g) = (heights[from], heights[to]);
        ((h > 0.0) != (g > 0.0)).then(|| triangle[from] + h / (h - g) * (triangle[to] - triangle[from]))
    };
    let mut ends = (0..3).filter_map(crossing);
    Some([ends.next()?, ends.next()?])
}

/// Cuts a cell along the lines of all segments that enter it by more than `finest`.
fn cut(cell: ConvexCell, normal: DVec3, segments: &[PlaneSegment], finest: f64, into: &mut Vec<ConvexCell>) {
    for (k, &[a, b]) in segments.iter().enumerate() {
        let Some(along) = unit(b - a) else { continue };
        let aside = normal.cross(along);
        let beside = |point: DVec3| aside.dot(point - a);
        let (low, high) = cell.iter().map(|&c| beside(c)).fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
        if low < -finest && high > finest && inside(&cell, normal, [a, along], (b - a).length()) > finest {
            if into.len() >= MAX_CELLS {
                break;
            }
            let rest = &segments[k + 1..];
            cut(clipped(&cell, beside), normal, rest, finest, into);
            cut(clipped(&cell, |point| -beside(point)), normal, rest, finest, into);
            return;
        }
    }
    into.push(cell);
}

/// The length of a segment's part inside a cell.
fn inside(cell: &[DVec3], normal: DVec3, [start, along]: [DVec3; 2], length: f64) -> f64 {
    let (mut from, mut to) = (0.0_f64, length);
    for (i, &corner) in cell.iter().enumerate() {
        let inwards = normal.cross(cell[(i + 1) % cell.len()] - corner);
        let (height, slope) = (inwards.dot(start - corner), inwards.dot(along));
        // A point is inside where height + t slope >= 0.
        if slope > 0.0 {
            from = from.max(-height / slope);
        } else if slope < 0.0 {
            to = to.min(-height / slope);
        } else if height < 0.0 {
            return 0.0;
        }
    }
    to - from
}

/// Returns `true` if the first hit of every test ray is the back of a surface. Mostly the first ray decides.
fn is_covered(cell: &[DVec3], patch: &Patch, lift: f64, mesh: &Mesh, tracer: &Tracer<'_>) -> bool {
    let normal = patch.normal();
    let along = unit(patch.center() - patch.corners()[0]).unwrap_or(normal);
    let aside = normal.cross(along);
    test_points(cell).into_iter().all(|point| {
        let start = narrow(point + lift * normal);
        let mut tangents = TANGENTS.iter().flat_map(|&x| TANGENTS.map(|y| [x, y]));
        tangents.all(|[x, y]| {
            let direction = normal + (x * along + y * aside);
            Ray::new(start, narrow(direction)).is_ok_and(|ray| sees_a_back(&ray, mesh, tracer))
        })
    })
}

fn sees_a_back(ray: &Ray, mesh: &Mesh, tracer: &Tracer<'_>) -> bool {
    let hit = tracer.nearest(ray, Sides::Both).and_then(|hit| mesh.corners(hit.triangle));
    hit.is_some_and(|corners| {
        let [a, b, c] = corners.map(wide);
        (b - a).cross(c - a).dot(wide(ray.direction())) > 0.0
    })
}

fn middle(cell: &[DVec3]) -> DVec3 {
    1.0 / cell.len() as f64 * cell.iter().sum::<DVec3>()
}

/// The centre of a cell, and a point towards each corner.
fn test_points(cell: &[DVec3]) -> Vec<DVec3> {
    let middle = middle(cell);
    let towards = |&corner: &DVec3| middle + OUTWARDS * (corner - middle);
    std::iter::once(middle).chain(cell.iter().map(towards)).collect()
}

fn pieces(cell: &[DVec3], patch: &Patch) -> Vec<Patch> {
    let rest = &cell[1..];
    (0..rest.len().saturating_sub(1))
        .step_by(2)
        .filter_map(|k| {
            let outline: Vec<DVec3> = std::iter::once(cell[0]).chain(rest[k..].iter().copied().take(3)).collect();
            Patch::new(&outline, patch.face, patch.material)
        })
        .collect()
}
