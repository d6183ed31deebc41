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
