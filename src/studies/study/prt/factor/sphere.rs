//! Pictures of a sphere with a given reflectance under two distant lights.

use std::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;

use crate::picture::Picture;
use crate::study::prt::lit_view::single_picture;

/// Pixels per side of the picture.
pub(super) const SIZE: u32 = 160;

/// Directions towards the lights, not normalised, and their irradiances: a frontal light, and a grazing one. z is up,
/// the eye looks along y.
const LIGHTS: [(DVec3, f64); 2] = [(DVec3::new(-0.5, -0.6, 0.62), PI), (DVec3::new(0.9, 0.35, 0.1), 0.5 * PI)];

/// Radiance of each pixel towards the eye, grey, rows from the top; 0 outside the sphere. `f` is reflectance times
/// cosine, by local view and light directions; tangents run along the circles of latitude.
pub(super) fn radiance(f: &(dyn Fn(DVec3, DVec3) -> f64 + Sync)) -> Vec<[f64; 3]> {
    let at = |place: u32| (2.0 * f64::from(place) + 1.0) / f64::from(SIZE) - 1.0;
    let pixel = |pixel: u32| {
        let [x, z] = [at(pixel % SIZE), -at(pixel / SIZE)].map(|along| 1.05 * along);
        let square = 1.0 - x * x - z * z;
        if square <= 0.0 {
            return [0.0; 3];
        }
        let normal = DVec3::new(x, -square.sqrt(), z);
        let tangent = DVec3::Z.cross(normal).normalize();
        let bitangent = normal.cross(tangent);
        let local =
            |direction: DVec3| DVec3::new(tangent.dot(direction), bitangent.dot(direction), normal.dot(direction));
        let view = local(DVec3::NEG_Y);
        let of = |(light, irradiance): &(DVec3, f64)| {
            let light = local(light.normalize());
            if light.z > 0.0 { irradiance * f(view, light) } else { 0.0 }
        };
        [LIGHTS.iter().map(of).sum(); 3]
    };
    (0..SIZE * SIZE).into_par_iter().map(pixel).collect()
}

pub(super) fn picture(radiance: &[[f64; 3]]) -> Picture {
    single_picture(SIZE, SIZE, radiance)
}
