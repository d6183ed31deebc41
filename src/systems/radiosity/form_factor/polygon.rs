//! Form factors from a point to a polygon, in closed form (Lambert, 1760): `1 / (2 pi)` times the sum over the sides
//! of the angle at which the point sees a side, times the cosine between the point's normal and the normal of the
//! plane through point and side.

use std::f64::consts::PI;

use crate::elementary::atan2;
use crate::radiosity::Patch;
use glam::DVec3;

/// The form factor from a point with a normal (of length 1) to an unoccluded polygon, corners counter-clockwise from
/// its front: between 0 and 1. What lies behind the point's horizon does not count, nor does a polygon seen from
/// behind.
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

/// The part of a convex polygon where a linear function is not negative.
pub(in crate::radiosity) fn clipped(corners: &[DVec3], height: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (i, &here) in corners.iter().enumerate() {
        let next = corners[(i + 1) % corners.len()];
        let (h, k) = (height(here), height(next));
        if h >= 0.0 {
            kept.push(here);
        }
        if (h > 0.0 && k < 0.0) || (h < 0.0 && k > 0.0) {
            kept.push(here + h / (h - k) * (next - here));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    /// Faces the point from above: counter-clockwise seen from below.
    const LID: [DVec3; 4] = [
        DVec3::new(-1.0, -1.0, 1.0),
        DVec3::new(-1.0, 1.0, 1.0),
        DVec3::new(1.0, 1.0, 1.0),
        DVec3::new(1.0, -1.0, 1.0),
    ];

    #[test]
    fn a_square_above_its_middle_has_the_textbook_factor() {
        // Four corner rectangles of sides 1 and 1 at height 1: each 1 / (pi sqrt 2) atan(1 / sqrt 2).
        let corner = atan2(1.0, 2.0_f64.sqrt()) / (PI * 2.0_f64.sqrt());
        let found = point_to_polygon(DVec3::ZERO, DVec3::Z, &LID);
        assert_abs_diff_eq!(found, 4.0 * corner, epsilon = 1e-15);
        let mut back = LID;
        back.reverse();
        assert_eq!(point_to_polygon(DVec3::ZERO, DVec3::Z, &back), 0.0, "its back is black");
        assert_eq!(point_to_polygon(DVec3::ZERO, DVec3::NEG_Z, &LID), 0.0, "behind the horizon");
    }

    #[test]
    fn the_horizon_cuts_what_straddles_it() {
        let half = point_to_polygon(DVec3::ZERO, DVec3::X, &LID);
        let front = LID.map(|corner| corner.with_x(corner.x.max(0.0)));
        assert_eq!(half, point_to_polygon(DVec3::ZERO, DVec3::X, &front));
        assert!(half > 0.0);
    }
}
