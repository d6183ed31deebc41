//! Clear sky with a sun.

use glam::DVec3;

use super::harmonics::MAX_ORDER;
use super::light::{HarmonicLight, unit};
use super::rule::DirectionRule;
use crate::elementary::{acos, exp};
use crate::error::{InputError, ensure};

/// Mean angular radius of the sun, in radians: 16 minutes of arc.
pub const SUN_RADIUS: f64 = 0.004_654;

/// Degree of the rule over the sky: doubling it changes the coefficients up to order 10 by less than 1e-5 of the first.
/// The sky's peak around the sun has no finite degree.
const SKY_DEGREE: usize = 255;

/// CIE standard clear sky (Kittler 1967; CIE publication 22, 1973) over z >= 0, a sun, and a ground below.
///
/// Relative to the zenith, the sky's radiance is f(gamma) phi(z) / (f(zenith angle of the sun) phi(1)), where gamma is
/// the angle from the sun, f(gamma) = 0.91 + 10 e^(-3 gamma) + 0.45 cos^2 gamma and phi(z) = 1 - e^(-0.32 / z).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearSky {
    /// Direction of the sun, of any length, z > 0.
    pub sun: DVec3,
    /// Radiance of the sun's disk.
    pub sun_radiance: [f64; 3],
    /// Radiance at the zenith.
    pub zenith: [f64; 3],
    /// Radiance from below the horizon.
    pub ground: [f64; 3],
}

impl ClearSky {
    /// Radiance of the sky relative to the zenith, without the sun's disk, in a unit direction above the horizon.
    pub fn relative(&self, direction: DVec3) -> Result<f64, InputError> {
        Ok(relative(self.sun_direction()?, direction))
    }

    /// Computes the coefficients of sky, sun and ground. Sun and ground are computed in closed form.
    pub fn light(&self, order: usize) -> Result<HarmonicLight, InputError> {
        assert!((1..=MAX_ORDER).contains(&order), "an order from 1 to {MAX_ORDER}, not {order}");
        let sun = self.sun_direction()?;
        let sky = DirectionRule::hemisphere(SKY_DEGREE).project(order, |v| relative(sun, v));
        let sky = HarmonicLight::colored(&sky, self.zenith)?;
        let sun = HarmonicLight::disk(order, sun, SUN_RADIUS, self.sun_radiance)?;
        let ground = HarmonicLight::disk(order, -DVec3::Z, std::f64::consts::FRAC_PI_2, self.ground)?;
        Ok(sky.plus(&sun).plus(&ground))
    }

    fn sun_direction(&self) -> Result<DVec3, InputError> {
        let sun = unit(self.sun)?;
        ensure!(sun.z > 0.0, "expected a sun above the horizon, z > 0, found {}", self.sun);
        Ok(sun)
    }
}

fn relative(sun: DVec3, direction: DVec3) -> f64 {
    let scattering = |cosine: f64| 0.91 + 10.0 * exp(-3.0 * acos(cosine.clamp(-1.0, 1.0))) + 0.45 * cosine * cosine;
    let thickness = |z: f64| if z > 0.0 { 1.0 - exp(-0.32 / z) } else { 1.0 };
    scattering(sun.dot(direction)) * thickness(direction.z) / (scattering(sun.z) * thickness(1.0))
}
