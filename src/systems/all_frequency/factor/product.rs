//! The product of reflectance and cosine.

use glam::DVec3;

use super::motion::ProductSymmetry;
use crate::transfer::brdf::Brdf;

/// The BRDF product function f(v, s) = b(v, s) s_z (section 2), per steradian, in local coordinates.
pub trait ProductFunction: Sync {
    /// f for two directions of length 1 above the horizon.
    fn value(&self, view: DVec3, light: DVec3) -> f64;

    /// Rotations and mirrorings that leave f unchanged.
    fn symmetry(&self) -> ProductSymmetry;
}

impl ProductFunction for Brdf {
    fn value(&self, view: DVec3, light: DVec3) -> f64 {
        Self::value(self, view, light) * light.z
    }

    fn symmetry(&self) -> ProductSymmetry {
        if self.is_isotropic() { ProductSymmetry::TurnsAndMirrors } else { ProductSymmetry::Mirrors }
    }
}
