//! What the host computes of a hit whose triangle it knows: `float_uvw*.psa` in f32, operation by operation.
//!
//! Written for being the same as the card, not for speed: it is asked once a hit.

use crate::geom::exact::Sides;
use crate::geom::{Mesh, Ray};
use crate::tracer::triangle_test::{HostRay, scaled_corners};

/// A point of a triangle's plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlanePoint {
    /// In multiples of the ray's direction, not yet rounded to single precision.
    pub(super) t: f64,
    /// u, v, w by -n.d, or by |n.d| for either side.
    pub(super) uvw: [f32; 3],
}

/// Where a ray meets the plane of a triangle, computed at a scale; `None` for a triangle that is not there.
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
