//! Equation 8 on the host, in f64: the irradiance that enters the surface.

use std::f64::consts::PI;

use glam::DVec3;

use super::fresnel::{fresnel_transmittance, mean_transmittance};
use super::on_card::Light;
use crate::atlas::{Atlas, Texel};
use crate::geom::Ray;
use crate::geom::vector::narrow;
use crate::tracer::offset::{SINGLE, SurfacePoint};
use crate::tracer::{CastError, Caster};

/// The irradiance that enters at each texel, row by row: E of equation 8 at the texel's mean point, for OpenGL's types
/// of lights (section 4.2.2). Lengths are in the mesh's units. A texel without a normal gets only the light of the sky.
pub fn irradiance(atlas: &Atlas, lights: &[Light], eta: f64) -> Vec<[f64; 3]> {
    let mean = mean_transmittance(eta);
    atlas.texels().iter().map(|texel| entering(texel, lights, eta, mean)).collect()
}

fn entering(texel: &Texel, lights: &[Light], eta: f64, mean: f64) -> [f64; 3] {
    let mut sum = DVec3::ZERO;
    for light in lights {
        sum += match *light {
            // Uniform radiance enters as pi times the radiance times the mean transmittance over cosines.
            Light::Sky { radiance } => PI * mean * DVec3::from(radiance),
            Light::Directional { towards, irradiance } => {
                transmitted(texel, DVec3::from(towards), eta) * DVec3::from(irradiance)
            }
            Light::Point { position, intensity, attenuation: [k0, k1, k2] } => {
                let to_light = DVec3::from(position) - texel.point;
                let distance = to_light.length();
                let attenuation = k0 + k1 * distance + k2 * distance * distance;
                transmitted(texel, to_light, eta) / attenuation * DVec3::from(intensity)
            }
        };
    }
    sum.to_array().map(|value| if value.is_finite() { value } else { 0.0 })
}

/// The cosine towards a light times the transmittance; 0 from behind.
fn transmitted(texel: &Texel, towards: DVec3, eta: f64) -> f64 {
    let cosine = texel.normal.dot(towards) / towards.length();
    if cosine > 0.0 { cosine * fresnel_transmittance(eta, cosine.min(1.0)) } else { 0.0 }
}

/// A source of parallel light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistantSource {
    /// Unit direction towards the source.
    pub towards: DVec3,
    /// Irradiance of a surface that faces the source: radiance times solid angle.
    pub irradiance: [f64; 3],
}

/// E of equation 8 per texel, row by row, for distant light with shadows: a ray from the middle of each texel towards
/// each source tests whether the model occludes the source. A source below the plane of the face counts as occluded.
/// The caster must trace both sides of faces. Fails with [`CastError`] if the caster fails.
pub fn distant_irradiance(
    atlas: &Atlas,
    sources: &[DistantSource],
    eta: f64,
    caster: &mut dyn Caster,
) -> Result<Vec<[f64; 3]>, CastError> {
    let corners = (0..atlas.places().len() as u32).flat_map(|face| atlas.corners(face));
    let (low, high) = corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), c| (l.min(c), h.max(c)));
    // Shadow rays end at t = 1, outside the model.
    let beyond = 2.0 * (high - low).length();
    let mut found = Vec::with_capacity(atlas.texels().len());
    let side = atlas.side() as usize;
    for (row, texels) in atlas.texels().chunks(side).enumerate() {
        let mut lit: Vec<(usize, DVec3)> = Vec::new();
        let mut rays: Vec<Ray> = Vec::new();
        for (column, texel) in texels.iter().enumerate() {
            let weights = atlas.places()[texel.face as usize].weights(column as f64 + 0.5, row as f64 + 0.5);
            let Some(point) = SurfacePoint::of(atlas.corners(texel.face), DVec3::from(weights), SINGLE) else {
                continue;
            };
            for source in sources.iter().filter(|source| point.normal.dot(source.towards) > 0.0) {
                let share = transmitted(texel, source.towards, eta);
                let start = point.lifted(source.towards, 0.0);
                if share > 0.0
                    && let Ok(ray) = Ray::new(start, narrow(beyond * source.towards))
                {
                    lit.push((column, share * DVec3::from(source.irradiance)));
                    rays.push(ray);
                }
            }
        }
        let mut sums = vec![DVec3::ZERO; texels.len()];
        for ((column, irradiance), occluded) in lit.into_iter().zip(caster.occluded(&rays)?) {
            sums[column] += if occluded { DVec3::ZERO } else { irradiance };
        }
        found.extend(sums.into_iter().map(|sum| sum.to_array()));
    }
    Ok(found)
}
