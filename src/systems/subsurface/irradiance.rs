//! Equation 8 on the host, in f64: what enters the surface.

use std::f64::consts::PI;

use glam::DVec3;

use super::fresnel::{fresnel_transmittance, mean_transmittance};
use super::on_card::Light;
use crate::atlas::{Atlas, Texel};

/// The irradiance that enters at each texel, row by row: E of equation 8 at its mean point, for lights of OpenGL's
/// kinds (section 4.2.2). Lengths in the mesh's units. A texel without a normal gets the light of the sky alone.
pub fn irradiance(atlas: &Atlas, lights: &[Light], eta: f64) -> Vec<[f64; 3]> {
    let mean = mean_transmittance(eta);
    atlas.texels().iter().map(|texel| entering(texel, lights, eta, mean)).collect()
}

fn entering(texel: &Texel, lights: &[Light], eta: f64, mean: f64) -> [f64; 3] {
    let mut sum = DVec3::ZERO;
    for light in lights {
        sum += match *light {
            // The same radiance from everywhere: pi times it, times the mean of the transmittance over cosines.
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
