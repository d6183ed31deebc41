//! The reflectance that transfer was computed for.

use glam::DVec3;

use super::factor::{DiffuseFactor, ProductFactors};

/// f(v, s) = G(v) . F(s), without the color of the surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Reflectance {
    /// The one term of a diffuse surface of albedo 1, exact.
    Diffuse,
    /// Factors by texels.
    Factored(ProductFactors),
}

impl Reflectance {
    const WHITE: DiffuseFactor = DiffuseFactor { albedo: 1.0 };

    /// The number of terms m.
    pub const fn terms(&self) -> usize {
        match self {
            Self::Diffuse => 1,
            Self::Factored(factors) => factors.terms(),
        }
    }

    /// G at a direction of length 1 towards the viewer, in the local frame. There is nothing to see from below.
    ///
    /// # Panics
    /// If there is not a place per term.
    pub fn view(&self, direction: DVec3, into: &mut [f64]) {
        match self {
            _ if direction.z <= 0.0 => into.fill(0.0),
            Self::Diffuse => into[0] = Self::WHITE.view(),
            Self::Factored(factors) => factors.view(direction, into),
        }
    }

    /// F at a direction of length 1 towards the light, in the local frame.
    ///
    /// # Panics
    /// If there is not a place per term.
    pub fn light(&self, direction: DVec3, into: &mut [f64]) {
        match self {
            Self::Diffuse => into[0] = DiffuseFactor::light(direction),
            Self::Factored(factors) => factors.light(direction, into),
        }
    }
}
