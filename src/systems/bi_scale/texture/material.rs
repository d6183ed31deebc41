//! Materials of the texels of a patch.

use std::f64::consts::FRAC_1_PI;

use glam::DVec3;

use crate::error::InputError;
use crate::transfer::brdf::Brdf;

/// A diffuse color and a glossy lobe.
#[derive(Clone, Debug, PartialEq)]
pub struct MesoMaterial {
    /// Reflectance of the diffuse part: red, green, blue.
    pub color: [f64; 3],
    /// The lobe, in the frame of the surface with x along the texel's tangent.
    pub lobe: Option<Brdf>,
    /// Factors of the lobe: red, green, blue.
    pub lobe_color: [f64; 3],
}

impl MesoMaterial {
    /// A Lambert surface.
    pub fn diffuse(color: [f64; 3]) -> Self {
        Self { color, lobe: None, lobe_color: [0.0; 3] }
    }

    /// Checks that all parameters are in range.
    ///
    /// # Errors
    /// [`InputError`] for the first that is not.
    pub fn check(&self) -> Result<(), InputError> {
        for albedo in self.color {
            Brdf::Lambert { albedo }.check()?;
        }
        for albedo in self.lobe_color {
            Brdf::Lambert { albedo }.check()?;
        }
        self.lobe.map_or(Ok(()), |lobe| lobe.check())
    }

    /// The BRDF per channel, in 1/sr; 0 unless both directions are above the surface.
    pub fn value(&self, view: DVec3, light: DVec3) -> [f64; 3] {
        if !(view.z > 0.0 && light.z > 0.0) {
            return [0.0; 3];
        }
        let lobe = self.lobe.map_or(0.0, |lobe| lobe.value(view, light));
        [0, 1, 2].map(|channel| self.color[channel] * FRAC_1_PI + self.lobe_color[channel] * lobe)
    }
}
