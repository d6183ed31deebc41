//! Orthonormal frames around a normal, and the mean of a color.

use glam::DVec3;

use crate::geom::vector::least_axis;

/// Mean of a color's channels, by which lobes and lights are chosen. Any positive weight would be unbiased.
pub(super) fn mean(color: DVec3) -> f64 {
    color.element_sum() / 3.0
}

/// Returns two directions that form a right-handed frame with a unit vector.
pub(super) fn frame(normal: DVec3) -> [DVec3; 2] {
    let tangent = least_axis(normal).cross(normal);
    let tangent = 1.0 / tangent.length() * tangent;
    [tangent, normal.cross(tangent)]
}

/// Converts a direction from the local frame of a unit vector to global coordinates.
pub(super) fn turned(local: DVec3, normal: DVec3) -> DVec3 {
    let [tangent, other] = frame(normal);
    local.x * tangent + local.y * other + local.z * normal
}
