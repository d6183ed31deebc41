//! Orthonormal frames around a normal, and the mean of a color.

use glam::DVec3;

use crate::geom::vector::least_axis;

/// Mean of a color's channels, by which lobes and lights are chosen. Any positive weight would be unbiased.
pub(super) fn mean(color: DVec3) -> f64 {
    color.element_sum() / 3.0
}

/// Converts a direction from a right-handed local frame of a unit vector to global coordinates.
pub(super) fn turned(local: DVec3, normal: DVec3) -> DVec3 {
    let tangent = least_axis(normal).cross(normal);
    let tangent = 1.0 / tangent.length() * tangent;
    local.x * tangent + local.y * normal.cross(tangent) + local.z * normal
}
