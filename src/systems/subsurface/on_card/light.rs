//! OpenGL's types of lights, and their constants for the programs.

use glam::DVec3;
use std::f64::consts::PI;

use super::model::CardModel;
use crate::card::CardError;
use crate::geom::vector::unit;

/// The maximum distance of a point light, in units of the model: its square is within single precision.
const FARTHEST: f64 = 1e15;
/// The smallest squared distance to a light, in squared units of the model; nearer lights count as at this distance.
pub(super) const LEAST_SQUARE: f32 = 1e-8;
/// The smallest squared length by which a vector is normalised, so that a zero vector stays zero.
pub(super) const LEAST_LENGTH: f32 = 1e-30;

/// A light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Uniform radiance from all directions (OpenGL's ambient light); it enters with the mean transmittance.
    Sky {
        /// Radiance.
        radiance: [f64; 3],
    },
    /// Parallel light.
    Directional {
        /// The direction towards the light, of any length.
        towards: [f64; 3],
        /// Irradiance of a surface that faces the light.
        irradiance: [f64; 3],
    },
    /// Light from a point; its irradiance at distance d is intensity / (k0 + k1 d + k2 d^2).
    Point {
        /// Position.
        position: [f64; 3],
        /// Radiant intensity, if the attenuation is 0, 0, 1.
        intensity: [f64; 3],
        /// k0, k1, k2; physically 0, 0, 1.
        attenuation: [f64; 3],
    },
}

/// A directional or point light in the card's units.
#[derive(Clone, Copy, Debug)]
pub(super) struct CardLight {
    /// Position and 1, or direction and 0.
    pub(super) place: [f32; 4],
    pub(super) color: [f64; 3],
    pub(super) attenuation: [f32; 4],
}

/// All lights; skies are combined into one radiance.
#[derive(Clone, Debug, Default)]
pub(super) struct CardLights {
    pub(super) sky: [f64; 3],
    pub(super) list: Vec<CardLight>,
}

impl CardLights {
    pub(super) fn new(lights: &[Light], model: &CardModel) -> Result<Self, CardError> {
        let mut all = Self::default();
        for (number, light) in lights.iter().enumerate() {
            let wrong = |what: &str| Err(CardError::input(format!("light {number} (counted from 0): expected {what}")));
            let (Light::Sky { radiance: color }
            | Light::Directional { irradiance: color, .. }
            | Light::Point { intensity: color, .. }) = light;
            if !color.iter().all(|value| (0.0..=f64::from(f32::MAX)).contains(value)) {
                return wrong("finite colors of at least 0");
            }
            match *light {
                Light::Sky { radiance } => all.sky.iter_mut().zip(radiance).for_each(|(sum, value)| *sum += value),
                Light::Directional { towards, irradiance } => {
                    let Some(towards) = unit(DVec3::from(towards)) else { return wrong("a direction") };
                    let [x, y, z] = towards.to_array().map(|value| value as f32);
                    let attenuation = [1.0, 0.0, 0.0, 0.0];
                    all.list.push(CardLight { place: [x, y, z, 0.0], color: irradiance, attenuation });
                }
                Light::Point { position, intensity, attenuation } => {
                    let place = model.frame().of_scene(DVec3::from(position));
                    if !(0.0..=FARTHEST).contains(&place.length()) {
                        return wrong("a point light within 1e15 radii of the model; a directional one is farther");
                    }
                    let [x, y, z] = place.to_array().map(|value| value as f32);
                    let [k0, k1, k2] = attenuation;
                    let unit = model.frame().unit();
                    let factors = [k0, k1 * unit, k2 * unit * unit];
                    let largest = factors.into_iter().fold(0.0, f64::max);
                    let fine = attenuation.iter().all(|k| *k >= 0.0) && largest > 0.0 && largest.is_finite();
                    let color = intensity.map(|value| value / largest);
                    if !fine || !color.iter().all(|value| (0.0..=f64::from(f32::MAX)).contains(value)) {
                        return wrong("an attenuation of finite factors of at least 0, one of them above 0");
                    }
                    let [k0, k1, k2] = factors.map(|factor| (factor / largest) as f32);
                    all.list.push(CardLight { place: [x, y, z, 1.0], color, attenuation: [k0, k1, k2, 0.0] });
                }
            }
        }
        Ok(all)
    }

    pub(super) fn sky_irradiance(&self, mean_transmittance: f64, factor: f64) -> [f32; 4] {
        let [r, g, b] = self.sky.map(|radiance| narrow(radiance * PI * mean_transmittance * factor));
        [r, g, b, 0.0]
    }
}

pub(super) fn colored(color: [f64; 3], factor: impl Fn(usize) -> f64) -> [f32; 4] {
    let [r, g, b] = [0, 1, 2].map(|channel| narrow(color[channel] * factor(channel)));
    [r, g, b, 0.0]
}

/// Rounds to single precision; overflow gives the largest finite number.
fn narrow(value: f64) -> f32 {
    (value as f32).min(f32::MAX)
}
