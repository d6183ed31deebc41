//! The product of reflectance and cosine.

use std::f64::consts::PI;

use glam::DVec3;

use super::motion::ProductSymmetry;
use crate::elementary::pow;
use crate::transfer::brdf::Brdf;

/// The BRDF product function f(v, s) = b(v, s) s_z (section 2), per steradian, in local coordinates.
pub trait ProductFunction: Sync {
    /// f for two directions of length 1 above the horizon; also below it where [`Self::continues`] is true.
    fn value(&self, view: DVec3, light: DVec3) -> f64;

    /// True if the formula can be evaluated below the horizon too.
    fn continues(&self) -> bool;

    /// Rotations and mirrorings that leave f unchanged.
    fn symmetry(&self) -> ProductSymmetry;

    /// Its name in messages.
    fn name(&self) -> &'static str;
}

impl ProductFunction for Brdf {
    fn value(&self, view: DVec3, light: DVec3) -> f64 {
        match *self {
            Self::Lambert { albedo } => albedo / PI * light.z,
            Self::Phong { albedo, specular, exponent } => {
                let from_axis = (view.z * light.z - view.x * light.x - view.y * light.y).max(0.0);
                (albedo / PI + specular * (exponent + 2.0) / (2.0 * PI) * pow(from_axis, exponent)) * light.z
            }
            _ => Self::value(self, view, light) * light.z,
        }
    }

    fn continues(&self) -> bool {
        matches!(self, Self::Lambert { .. } | Self::Phong { .. })
    }

    fn symmetry(&self) -> ProductSymmetry {
        if self.is_isotropic() { ProductSymmetry::TurnsAndMirrors } else { ProductSymmetry::Mirrors }
    }

    fn name(&self) -> &'static str {
        match self {
            Self::Lambert { .. } => "Lambert's law",
            Self::Phong { .. } => "Phong's model",
            _ => "a microfacet model of `transfer::brdf`",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_product_is_reflectance_times_cosine() {
        let [view, light] = [DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.48, 0.36, 0.8)];
        for brdf in [
            Brdf::Lambert { albedo: 0.7 },
            Brdf::Phong { albedo: 0.3, specular: 0.6, exponent: 20.0 },
            Brdf::CookTorrance { albedo: 0.2, specular: 1.0, roughness: 0.3, normal_incidence: 0.6 },
            Brdf::Ward { albedo: 0.2, specular: 0.4, roughness: [0.15, 0.5] },
        ] {
            let [found, expected] = [ProductFunction::value(&brdf, view, light), brdf.value(view, light) * light.z];
            assert!((found - expected).abs() <= 1e-15 * expected, "{brdf:?}: {found} {expected}");
        }
        let below = light.with_z(-0.8);
        let lambert = Brdf::Lambert { albedo: 0.7 };
        assert_eq!(ProductFunction::value(&lambert, view, below), -ProductFunction::value(&lambert, view, light));
    }
}
