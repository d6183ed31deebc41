//! Host evaluation of a hit on a known triangle: `float_uvw*.psa` in f32, operation by operation.
//!
//! Written for bit equality with the card, not for speed: it runs once per hit.

use crate::geom::exact::Sides;
use crate::geom::{Mesh, Ray};
use crate::tracer::triangle_test::{HostRay, scaled_corners};

/// Intersection of a ray with the plane of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlanePoint {
    /// Ray parameter in multiples of the ray's direction, not yet rounded to single precision.
    pub(super) t: f64,
    /// u, v, w divided by -n.d, or by |n.d| if both sides count.
    pub(super) uvw: [f32; 3],
}

/// Intersects a ray with the plane of a triangle, in coordinates multiplied by `scale`. `None` if the mesh has no such
/// triangle.
pub(super) fn plane_point(mesh: &Mesh, scale: f64, triangle: u32, ray: &Ray, sides: Sides) -> Option<PlanePoint> {
    let [a, b, c] = scaled_corners(mesh.corners(triangle)?, scale);
    let HostRay { origin, direction: d, power } = HostRay::new(ray, scale);
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let n = ab.cross(ac);
    let (ao, bo) = (origin - a, origin - b);
    let n_dot_d = n.dot(d);
    let inverse = n_dot_d.recip();
    let (aod, bod) = (ao.cross(d), bo.cross(d));
    let uvw = [ac.dot(aod), (-ab).dot(aod), (-bc).dot(bod)];
    let uvw = match sides {
        Sides::Front => uvw.map(|x| x * -inverse),
        Sides::Both if n_dot_d >= 0.0 => uvw.map(|x| -x * inverse.abs()),
        Sides::Both => uvw.map(|x| x * inverse.abs()),
    };
    let t = n.dot(ao) * -inverse;
    Some(PlanePoint { t: f64::from(t) * power, uvw })
}
