//! Clipping in homogeneous coordinates, in FP32 operations.

use super::state::ClipSpace;
use super::vertex::{COMPONENTS, Vertex};
use crate::texture::value;

/// Guard band: the multiple of the viewport's half extents at which triangles are clipped, 8 (FP32 bits).
pub(crate) const GUARD_BAND: u32 = 0x4100_0000;

/// A vertex of the clipper: position and interpolated components.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClipVertex {
    pub(crate) position: [u32; 4],
    pub(crate) components: [u32; COMPONENTS],
    /// `true` if the polygon's edge to the next corner lies on an edge of the triangle, not on a clip plane.
    pub(crate) begins_edge: bool,
}

impl ClipVertex {
    pub(crate) fn new(vertex: &Vertex) -> Self {
        Self { position: vertex.position, components: vertex.components(), begins_edge: true }
    }
}

/// Smallest w that is not clipped: 2^-64. It approximates w > 0 and keeps 1/w finite.
pub(crate) const LEAST_W: u32 = (127 - 64) << 23;

/// The clip planes, named by the quantity that must not be negative.
#[derive(Clone, Copy, Debug)]
enum ClipPlane {
    W,
    Near,
    Far,
    Left,
    Right,
    Bottom,
    Top,
}

const PLANES: [ClipPlane; 7] = [
    ClipPlane::W,
    ClipPlane::Near,
    ClipPlane::Far,
    ClipPlane::Left,
    ClipPlane::Right,
    ClipPlane::Bottom,
    ClipPlane::Top,
];

/// FP32 distance of a position from a plane, in clip space units; negative outside.
fn distance(plane: ClipPlane, space: ClipSpace, [x, y, z, w]: [u32; 4]) -> u32 {
    let band = value::mul(w, GUARD_BAND);
    match (plane, space) {
        (ClipPlane::W, _) => value::sub(w, LEAST_W),
        (ClipPlane::Near, ClipSpace::Direct3d) => z,
        (ClipPlane::Near, ClipSpace::OpenGl) => value::add(z, w),
        (ClipPlane::Far, _) => value::sub(w, z),
        (ClipPlane::Left, _) => value::add(band, x),
        (ClipPlane::Right, _) => value::sub(band, x),
        (ClipPlane::Bottom, _) => value::add(band, y),
        (ClipPlane::Top, _) => value::sub(band, y),
    }
}

fn is_outside(distance: u32) -> bool {
    value::is_negative(distance) || value::is_nan(distance)
}

/// A clipped triangle; each of the seven planes adds at most one corner.
pub(crate) struct Polygon {
    corners: [ClipVertex; 10],
    count: usize,
}

impl Polygon {
    pub(crate) fn corners(&self) -> &[ClipVertex] {
        &self.corners[..self.count]
    }

    fn push(&mut self, corner: ClipVertex) {
        if let Some(slot) = self.corners.get_mut(self.count) {
            *slot = corner;
            self.count += 1;
        }
    }
}

/// Returns `true` if no plane cuts the triangle, so that it needs no clipping.
pub(crate) fn is_inside(triangle: &[&Vertex; 3], space: ClipSpace) -> bool {
    triangle.iter().all(|v| PLANES.iter().all(|&p| !is_outside(distance(p, space, v.position))))
}

/// Clips a triangle by all planes (Sutherland-Hodgman). The result is convex, with its corners in the original order.
///
/// A new corner on the edge from an inside to an outside vertex is `inside + t * (outside - inside)` with
/// `t = d_inside / (d_inside - d_outside)`, each step in FP32. The result does not depend on the direction of the edge,
/// so two triangles get the same corner on a common edge. Components that are equal at both ends are copied.
pub(crate) fn clip(triangle: [&Vertex; 3], space: ClipSpace) -> Polygon {
    let start = triangle.map(ClipVertex::new);
    let mut polygon = Polygon { corners: [start[0]; 10], count: 0 };
    start.into_iter().for_each(|corner| polygon.push(corner));
    for plane in PLANES {
        let source = Polygon { corners: polygon.corners, count: polygon.count };
        polygon.count = 0;
        for (i, corner) in source.corners().iter().enumerate() {
            let next = &source.corners[(i + 1) % source.count];
            let (d, d_next) = (distance(plane, space, corner.position), distance(plane, space, next.position));
            if !is_outside(d) {
                polygon.push(*corner);
            }
            match (is_outside(d), is_outside(d_next)) {
                // The clipped polygon's next edge lies on the plane.
                (false, true) => polygon.push(crossing(corner, d, next, d_next, false)),
                // The clipped polygon's next edge continues the edge that enters.
                (true, false) => polygon.push(crossing(next, d_next, corner, d, corner.begins_edge)),
                _ => {}
            }
        }
    }
    polygon
}

/// Intersection of a plane with the edge from an inside to an outside vertex.
fn crossing(inside: &ClipVertex, d_inside: u32, outside: &ClipVertex, d_outside: u32, begins_edge: bool) -> ClipVertex {
    let t = value::div(d_inside, value::sub(d_inside, d_outside));
    let between = |a: u32, b: u32| if a == b { a } else { value::add(a, value::mul(t, value::sub(b, a))) };
    ClipVertex {
        position: std::array::from_fn(|i| between(inside.position[i], outside.position[i])),
        components: std::array::from_fn(|i| between(inside.components[i], outside.components[i])),
        begins_edge,
    }
}
