//! Mirrors and glass: where light goes, and how much of it.

use super::vector::{Vec3, along, dot, scale, sub, unit};

/// The mirror image of a direction that points away from the surface.
pub fn reflected(away: Vec3, normal: Vec3) -> Vec3 {
    sub(scale(normal, 2.0 * dot(away, normal)), away)
}

/// How much unpolarised light a smooth boundary reflects (Fresnel's equations). `cosine` is that of the angle to the normal on the
/// side of the light, `ratio` the index of that side over that of the other. 1 under total internal reflection.
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

/// Where a ray goes that crosses the boundary (Snell's law): `away` points from the surface back along the ray, `normal` to the same
/// side. `None` under total internal reflection.
pub fn refracted(away: Vec3, normal: Vec3, ratio: f64) -> Option<Vec3> {
    let cosine = dot(away, normal);
    let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if square <= 0.0 {
        return None;
    }
    unit(along(scale(away, -ratio), normal, ratio * cosine - square.sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::renderer::vector::length;

    #[test]
    fn fresnel_at_the_angles_that_have_a_name() {
        // Head on: ((n - 1) / (n + 1))^2.
        assert!((reflectance(1.0, 1.0 / 1.5) - 0.04).abs() < 1e-15);
        assert!((reflectance(1.0, 1.5) - 0.04).abs() < 1e-15);
        assert_eq!(reflectance(0.0, 1.0 / 1.5), 1.0);
        // Brewster's angle, tan = n: one polarisation is not reflected, the other by ((n^2 - 1) / (n^2 + 1))^2.
        let cosine = 1.0 / (1.0_f64 + 2.25).sqrt();
        let other = (1.25 / 3.25) * (1.25 / 3.25);
        assert!((reflectance(cosine, 1.0 / 1.5) - other / 2.0).abs() < 1e-15);
        // Beyond the critical angle, sin = 1 / n.
        assert_eq!(reflectance(0.7, 1.5), 1.0);
        assert!(reflectance(0.8, 1.5) < 1.0);
    }

    #[test]
    fn snell() {
        let normal = [0.0, 0.0, 1.0];
        let away = unit([0.6, 0.0, 0.8]).expect("a direction");
        let inside = refracted(away, normal, 1.0 / 1.5).expect("it enters");
        assert!((inside[0] + 0.4).abs() < 1e-15 && inside[2] < 0.0, "{inside:?}");
        let back = refracted(inside, [0.0, 0.0, -1.0], 1.5).expect("it leaves as it came");
        assert!(length(sub(back, away)) < 1e-15);
        assert_eq!(refracted([0.8, 0.0, 0.6], normal, 1.5), None);
        assert_eq!(reflected([0.6, 0.0, 0.8], normal), [-0.6, 0.0, 0.8]);
    }
}
