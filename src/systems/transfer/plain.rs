//! Rays tested against every triangle, for the references of systems 4 and 5, which share no arithmetic with the tested
//! code.

use glam::DVec3;

use super::Vertices;
use crate::geom::vector::{unit, wide};

/// Distance of ray origins from the triangles at a vertex, relative to the mesh's size.
const LIFT: f64 = 1e-7;

/// The position of a vertex, moved off the triangles that meet there.
pub(crate) fn plain_origin(vertices: &Vertices, vertex: usize) -> DVec3 {
    let place = wide(vertices.positions()[vertex]);
    let mut towards = DVec3::ZERO;
    let mut size: f64 = 0.0;
    for triangle in 0..vertices.triangles().len() {
        let [a, b, c] = vertices.corners(triangle as u32);
        size = size.max(a.distance(place));
        if [a, b, c].contains(&place) {
            towards += unit((b - a).cross(c - a)).unwrap_or(DVec3::ZERO);
        }
    }
    place + LIFT * size * unit(towards).unwrap_or(DVec3::ZERO)
}

/// The first triangle along a ray, from either side, with barycentric weights of the hit (Moeller and Trumbore).
pub(crate) fn plain_hit(vertices: &Vertices, origin: DVec3, direction: DVec3) -> Option<(usize, [f64; 3])> {
    let mut first: Option<(f64, usize, [f64; 3])> = None;
    for triangle in 0..vertices.triangles().len() {
        let [a, b, c] = vertices.corners(triangle as u32);
        let (ab, ac) = (b - a, c - a);
        let across = direction.cross(ac);
        let determinant = ab.dot(across);
        if determinant == 0.0 {
            continue;
        }
        let from = origin - a;
        let u = from.dot(across) / determinant;
        let v = direction.dot(from.cross(ab)) / determinant;
        let t = ac.dot(from.cross(ab)) / determinant;
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && first.is_none_or(|(nearest, ..)| t < nearest) {
            first = Some((t, triangle, [1.0 - u - v, u, v]));
        }
    }
    first.map(|(_, triangle, weights)| (triangle, weights))
}
