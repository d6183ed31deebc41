//! Reflection and refraction at mirrors and glass: directions and reflectance.

pub use crate::fresnel::reflectance;
use crate::geom::vector::unit;
use glam::DVec3;

/// Mirrors a direction that points away from the surface.
pub fn reflected(away: DVec3, normal: DVec3) -> DVec3 {
    2.0 * away.dot(normal) * normal - away
}

/// Refracts a ray at a boundary (Snell's law): `away` points from the surface back along the ray, `normal` to the same
/// side. `None` under total internal reflection.
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
    use approx::abs_diff_eq;

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
