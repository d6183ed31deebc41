//! Microfacet lobes, with the details that the paper leaves open as options.
//!
//! The paper cites Cook and Torrance 1982 and Schlick 1994 with two or three parameters each, and prints errors; it
//! does not say which factors of these models it used. [`Lobe`] has each factor as an option.

use std::f64::consts::PI;

use glam::DVec3;

use super::product::{ProductFunction, ProductSymmetry};
use crate::error::InputError;
use crate::fresnel::{dielectric, schlick};
use crate::transfer::brdf::Brdf;
use crate::transfer::brdf::facets::{
    beckmann, cosine_along_tangent, groove, schlick_azimuth, schlick_seen, schlick_zenith,
};

/// The factor before distribution, shadowing and Fresnel reflectance. Distributions are pi times the usual
/// distributions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "kebab-case")]
pub enum Denominators {
    /// 1 / (4 pi v_z s_z): facets conserve energy; Schlick 1994, and Cook and Torrance's model in textbooks.
    #[default]
    Normalised,
    /// 1 / (pi v_z s_z), as Cook and Torrance 1982 print it: four times `normalised`.
    #[strum(to_string = "printed-1982")]
    Printed1982,
    /// 1: without pi and cosines.
    Product,
    /// 1/4: Schlick's factor without pi and cosines.
    Quarter,
}

/// Fresnel reflectance from the reflectance at normal incidence and the angle to the half vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum FresnelForm {
    /// Fresnel's formula for dielectrics, unpolarised: Cook and Torrance.
    Dielectric,
    /// Schlick's approximation.
    Schlick,
    /// The reflectance at normal incidence, for all angles.
    Constant,
}

/// Shadowing and masking between facets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum Shadowing {
    /// The shadowing of the model: V-grooves for Cook and Torrance, G(v) G(v') for Schlick.
    #[default]
    Model,
    /// No shadowing and no masking.
    None,
}

/// Definition of w in Schlick's azimuth factor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TangentCosine {
    /// The cosine of the angle between the tangent and the half vector's projection onto the surface, as
    /// Schlick defines it.
    #[default]
    Projected,
    /// The half vector's component along the tangent, not divided by the length of the projection.
    HalfVector,
}

/// Distribution of the facets' normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FacetDistribution {
    /// Beckmann's, as used by Cook and Torrance.
    Beckmann {
        /// Root mean square slope.
        roughness: f64,
    },
    /// Schlick's Z(t) A(w).
    Schlick {
        /// In (0, 1].
        roughness: f64,
        /// In (0, 1]; 1 is isotropic.
        isotropy: f64,
        /// The definition of w.
        tangent: TangentCosine,
    },
}

/// A diffuse part and a lobe of microfacets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Reflectance of the diffuse part.
    pub albedo: f64,
    /// Distribution of the facets.
    pub distribution: FacetDistribution,
    /// Fresnel reflectance at normal incidence.
    pub normal_incidence: f64,
    /// Fresnel reflectance at other angles.
    pub fresnel: FresnelForm,
    /// Shadowing and masking between facets.
    pub shadowing: Shadowing,
    /// The factor before distribution, shadowing and Fresnel reflectance.
    pub denominators: Denominators,
}

impl Lobe {
    /// Cook and Torrance's model, in the form of [`Brdf::CookTorrance`].
    pub const fn cook_torrance(roughness: f64, normal_incidence: f64) -> Self {
        Self {
            albedo: 0.0,
            distribution: FacetDistribution::Beckmann { roughness },
            normal_incidence,
            fresnel: FresnelForm::Dielectric,
            shadowing: Shadowing::Model,
            denominators: Denominators::Normalised,
        }
    }

    /// Schlick's model, in the form of [`Brdf::Schlick`].
    pub const fn schlick(roughness: f64, isotropy: f64, normal_incidence: f64) -> Self {
        Self {
            albedo: 0.0,
            distribution: FacetDistribution::Schlick { roughness, isotropy, tangent: TangentCosine::Projected },
            normal_incidence,
            fresnel: FresnelForm::Schlick,
            shadowing: Shadowing::Model,
            denominators: Denominators::Normalised,
        }
    }

    /// Checks that all parameters are in range. Fails with [`InputError`] for the first that is not.
    pub fn check(&self) -> Result<(), InputError> {
        let Self { albedo, normal_incidence, .. } = *self;
        match self.distribution {
            FacetDistribution::Beckmann { roughness } if self.fresnel == FresnelForm::Dielectric => {
                Brdf::CookTorrance { albedo, specular: 1.0, roughness, normal_incidence }.check()
            }
            FacetDistribution::Beckmann { roughness } => {
                Brdf::CookTorrance { albedo, specular: 1.0, roughness, normal_incidence: 0.0 }.check()?;
                Brdf::Ward { albedo, specular: normal_incidence, roughness: [1.0; 2] }.check()
            }
            FacetDistribution::Schlick { roughness, isotropy, .. } => {
                Brdf::Schlick { albedo, specular: 1.0, roughness, isotropy, normal_incidence }.check()?;
                match self.fresnel {
                    // Reflectance 1 would need an infinite index of refraction.
                    FresnelForm::Dielectric => {
                        Brdf::CookTorrance { albedo, specular: 1.0, roughness, normal_incidence }.check()
                    }
                    FresnelForm::Schlick | FresnelForm::Constant => Ok(()),
                }
            }
        }
    }

    fn fresnel(&self, cosine: f64) -> f64 {
        match self.fresnel {
            FresnelForm::Dielectric => dielectric(self.normal_incidence, cosine),
            FresnelForm::Schlick => schlick(self.normal_incidence, cosine),
            FresnelForm::Constant => self.normal_incidence,
        }
    }

    fn facets(&self, half: DVec3) -> f64 {
        match self.distribution {
            FacetDistribution::Beckmann { roughness } => beckmann(half.z, roughness),
            FacetDistribution::Schlick { roughness, isotropy, tangent } => {
                let w = match tangent {
                    TangentCosine::Projected => cosine_along_tangent(half),
                    TangentCosine::HalfVector => half.x,
                };
                schlick_zenith(half.z, roughness) * schlick_azimuth(w, isotropy)
            }
        }
    }

    fn seen(&self, half_cosine: f64, cosine: f64, view: DVec3, light: DVec3) -> f64 {
        match (self.shadowing, self.distribution) {
            (Shadowing::None, _) => 1.0,
            (Shadowing::Model, FacetDistribution::Beckmann { .. }) => groove(half_cosine, view.z.min(light.z), cosine),
            (Shadowing::Model, FacetDistribution::Schlick { roughness, .. }) => {
                schlick_seen(view.z, roughness) * schlick_seen(light.z, roughness)
            }
        }
    }
}

impl ProductFunction for Lobe {
    fn value(&self, view: DVec3, light: DVec3) -> f64 {
        let sum = view + light;
        let half = sum / sum.length();
        let diffuse = self.albedo / PI * light.z;
        // Opposite directions have no half vector.
        if half.z.is_nan() || half.z <= 0.0 {
            return diffuse;
        }
        let cosine = half.dot(view).min(1.0);
        let facets = self.facets(half) * self.seen(half.z, cosine, view, light) * self.fresnel(cosine);
        diffuse
            + match self.denominators {
                Denominators::Normalised => facets / (4.0 * PI * view.z * light.z) * light.z,
                Denominators::Printed1982 => facets / (PI * view.z * light.z) * light.z,
                Denominators::Product => facets * light.z,
                Denominators::Quarter => 0.25 * facets * light.z,
            }
    }

    fn symmetry(&self) -> ProductSymmetry {
        match self.distribution {
            FacetDistribution::Schlick { isotropy, .. } if isotropy != 1.0 => ProductSymmetry::Mirrors,
            _ => ProductSymmetry::TurnsAndMirrors,
        }
    }
}
