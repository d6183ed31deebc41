//! Form factors from a point to a polygon, in closed form (Lambert, 1760): `1 / (2 pi)` times the sum, over the sides,
//! of the angle that the side subtends at the point times the cosine between the point's normal and the normal of the
//! plane through point and side.

use std::f64::consts::PI;

use crate::elementary::atan2;
use crate::geom::polygon::clipped;
use crate::radiosity::Patch;
use glam::DVec3;

/// The form factor from a point with a normal (of length 1) to an unoccluded polygon with corners counter-clockwise
/// from its front: between 0 and 1. The part behind the point's horizon, and a polygon seen from behind, count as 0.
pub fn point_to_polygon(point: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let above = clipped(corners, |corner| normal.dot(corner - point));
    let mut sum = 0.0;
    for (i, &corner) in above.iter().enumerate() {
        let (r, s) = (corner - point, above[(i + 1) % above.len()] - point);
        let across = s.cross(r);
        let sine = across.length();
        if sine > 0.0 {
            sum += atan2(sine, r.dot(s)) * across.dot(normal) / sine;
        }
    }
    (sum / (2.0 * PI)).clamp(0.0, 1.0)
}

/// The part of a polygon in front of a patch's plane.
pub(super) fn in_front_of(corners: &[DVec3], patch: &Patch) -> Vec<DVec3> {
    clipped(corners, |corner| patch.height(corner))
}
