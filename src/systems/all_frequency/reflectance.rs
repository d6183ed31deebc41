//! The reflectance for which transfer was computed.

use std::f64::consts::PI;

use glam::DVec3;

use super::factor::ProductFactors;

/// f(v, s) = G(v) . F(s), without the color of the surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Reflectance {
    /// The one term of a diffuse surface of albedo 1, exact: F = s_z and G = 1 / pi. In a table, interpolation would
    /// distort s_z, most at the horizon.
    Diffuse,
    /// Factors stored in texels.
    Factored(ProductFactors),
}

impl Reflectance {
    /// The number of terms m.
    pub const fn terms(&self) -> usize {
        match self {
            Self::Diffuse => 1,
            Self::Factored(factors) => factors.terms(),
        }
    }

    /// G at a direction of length 1 towards the viewer, in the local frame. G is 0 below the horizon. Panics if `into`
    /// does not have one element per term.
    pub fn view(&self, direction: DVec3, into: &mut [f64]) {
        match self {
            _ if direction.z <= 0.0 => into.fill(0.0),
            Self::Diffuse => into[0] = 1.0 / PI,
            Self::Factored(factors) => factors.view(direction, into),
        }
    }

    /// F at a direction of length 1 towards the light, in the local frame. Panics if `into` does not have one element
    /// per term.
    pub fn light(&self, direction: DVec3, into: &mut [f64]) {
        match self {
            Self::Diffuse => into[0] = direction.z.max(0.0),
            Self::Factored(factors) => factors.light(direction, into),
        }
    }
}
