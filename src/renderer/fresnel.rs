//! Mirrors and glass: where light goes, and how much of it.

use crate::geom::vector::unit;
use glam::DVec3;

/// The mirror image of a direction that points away from the surface.
pub fn reflected(away: DVec3, normal: DVec3) -> DVec3 {
    2.0 * away.dot(normal) * normal - away
}

/// How much unpolarised light a smooth boundary reflects (Fresnel's equations). `cosine` is that of the angle to the
/// normal on the side of the light, `ratio` the index of that side over that of the other. 1 under total internal
/// reflection.
pub fn reflectance(cosine: f64, ratio: f64) -> f64 {
    let cosine = cosine.clamp(0.0, 1.0);
    let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if square <= 0.0 {
        return 1.0;
    }
    let beyond = square.sqrt();
    let across = (ratio * cosine - beyond) / (ratio * cosine + beyond);
    let along = (cosine - ratio * beyond) / (cosine + ratio * beyond);
    (across * across + along * along) / 2.0
}

/// Where a ray goes that crosses the boundary (Snell's law): `away` points from the surface back along the ray,
/// `normal` to the same side. `None` under total internal reflection.
pub fn refracted(away: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    let cosine = away.dot(normal);
    let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if square <= 0.0 {
        return None;
    }
    unit(-ratio * away + (ratio * cosine - square.sqrt()) * normal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{abs_diff_eq, assert_abs_diff_eq};

    #[test]
    fn fresnel_at_the_angles_that_have_a_name() {
        // Head on: ((n - 1) / (n + 1))^2.
        assert_abs_diff_eq!(reflectance(1.0, 1.0 / 1.5), 0.04, epsilon = 1e-15);
        assert_abs_diff_eq!(reflectance(1.0, 1.5), 0.04, epsilon = 1e-15);
        assert_eq!(reflectance(0.0, 1.0 / 1.5), 1.0);
        // Brewster's angle, tan = n: one polarisation is not reflected, the other by ((n^2 - 1) / (n^2 + 1))^2.
        let cosine = 1.0 / (1.0_f64 + 2.25).sqrt();
        let other = (1.25 / 3.25) * (1.25 / 3.25);
        assert_abs_diff_eq!(reflectance(cosine, 1.0 / 1.5), other / 2.0, epsilon = 1e-15);
        // Beyond the critical angle, sin = 1 / n.
        assert_eq!(reflectance(0.7, 1.5), 1.0);
        assert!(reflectance(0.8, 1.5) < 1.0);
    }

    #[test]
    fn snell() {
        let normal = DVec3::Z;
        let away = unit(DVec3::new(0.6, 0.0, 0.8)).expect("a direction");
        let inside = refracted(away, normal, 1.0 / 1.5).expect("it enters");
        assert!(abs_diff_eq!(inside[0], -0.4, epsilon = 1e-15) && inside[2] < 0.0, "{inside:?}");
        let back = refracted(inside, DVec3::NEG_Z, 1.5).expect("it leaves as it came");
        assert!((back - away).length() < 1e-15);
        assert_eq!(refracted(DVec3::new(0.8, 0.0, 0.6), normal, 1.5), None);
        assert_eq!(reflected(DVec3::new(0.6, 0.0, 0.8), normal), DVec3::new(-0.6, 0.0, 0.8));
    }
}
