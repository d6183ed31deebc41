//! Orthonormal frames around a normal, and the mean of a color.

use glam::DVec3;

use crate::geom::vector::least_axis;

/// Mean of a color's channels, the importance of lobes and lights. Any positive weight would be unbiased.
pub(super) fn mean(color: DVec3) -> f64 {
    color.element_sum() / 3.0
}

/// Returns two directions that form a right-handed frame with a unit vector.
pub(super) fn frame(normal: DVec3) -> [DVec3; 2] {
    let tangent = least_axis(normal).cross(normal);
    let tangent = 1.0 / tangent.length() * tangent;
    [tangent, normal.cross(tangent)]
}

/// Converts a direction from the frame of a unit vector.
pub(super) fn turned(local: DVec3, normal: DVec3) -> DVec3 {
    let [tangent, other] = frame(normal);
    local.x * tangent + local.y * other + local.z * normal
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::abs_diff_eq;

    #[test]
    fn frames_are_square() {
        for normal in [DVec3::Z, DVec3::X, DVec3::new(0.6, -0.8, 0.0), DVec3::new(-2.0, 3.0, 6.0) / 7.0] {
            let [x, y] = frame(normal);
            assert!(x.dot(y).abs() < 1e-15 && x.dot(normal).abs() < 1e-15 && y.dot(normal).abs() < 1e-15);
            assert!(abs_diff_eq!(x.length(), 1.0, epsilon = 1e-15) && abs_diff_eq!(y.length(), 1.0, epsilon = 1e-15));
            assert!((x.cross(y) - normal).length() < 1e-15, "right-handed");
        }
    }
}
