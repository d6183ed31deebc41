//! What the host computes of a hit whose triangle it knows: `float_uvw*.psa` in f32, operation by operation.
//!
//! Written for being the same as the card, not for speed: it is asked once a hit.

use super::host_test::{HostRay, cross, dot, neg, scaled_corners, sub};
use crate::geom::exact::Sides;
use crate::geom::{Mesh, Ray};

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
    let (ab, ac, bc) = (sub(b, a), sub(c, a), sub(c, b));
    let n = cross(ab, ac);
    let (ao, bo) = (sub(origin, a), sub(origin, b));
    let n_dot_d = dot(n, d);
    let inverse = n_dot_d.recip();
    let (aod, bod) = (cross(ao, d), cross(bo, d));
    let uvw = [dot(ac, aod), dot(neg(ab), aod), dot(neg(bc), bod)];
    let uvw = match sides {
        Sides::Front => uvw.map(|x| x * -inverse),
        Sides::Both if n_dot_d >= 0.0 => neg(uvw).map(|x| x * inverse.abs()),
        Sides::Both => uvw.map(|x| x * inverse.abs()),
    };
    let t = dot(n, ao) * -inverse;
    Some(PlanePoint { t: f64::from(t) * power, uvw })
}
