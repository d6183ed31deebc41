//! BRDF models, one channel, in local coordinates: z is the normal, x the tangent.

use std::f64::consts::PI;

use glam::DVec3;

use super::facets;
use crate::elementary::{exp, pow};
use crate::error::{InputError, ensure, input_error};
use crate::fresnel::{dielectric, schlick};
use crate::scene::Surface;

/// A BRDF of one channel. All reflectances lie in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Brdf {
    /// Lambert: equal radiance in all directions.
    Lambert {
        /// Reflectance.
        albedo: f64,
    },
    /// A diffuse part and a lobe around the mirror direction, as in MTL files and in [`Surface::Glossy`].
    Phong {
        /// Reflectance of the diffuse part.
        albedo: f64,
        /// Reflectance of the lobe at normal incidence.
        specular: f64,
        /// Exponent of the lobe, at least 0.
        exponent: f64,
    },
    /// Cook and Torrance 1982, isotropic: Beckmann's distribution, shadowing by V-grooves, Fresnel's formula.
    CookTorrance {
        /// Reflectance of the diffuse part.
        albedo: f64,
        /// Factor of the microfacets.
        specular: f64,
        /// Root mean square slope of the microfacets, above 0.
        roughness: f64,
        /// Fresnel reflectance of the microfacets at normal incidence, below 1.
        normal_incidence: f64,
    },
    /// Schlick 1994, anisotropic, single layer: S(u) G(v) G(v') Z(t) A(w) / (4 pi v v'). Light that facets block from
    /// each other is lost; his term (1 - G G') / pi, which would restore it, is omitted. At grazing angles, where his G
    /// is too near 1, sharp lobes reflect more light than arrives: 1.27 for roughness 0.05 at z = 0.05.
    Schlick {
        /// Reflectance of the diffuse part.
        albedo: f64,
        /// Factor of the facets.
        specular: f64,
        /// Roughness in (0, 1]: towards 0 a mirror, at 1 equal in all directions.
        roughness: f64,
        /// Isotropy in (0, 1]: towards 0 wide across the tangent, at 1 isotropic.
        isotropy: f64,
        /// Reflectance of the facets at normal incidence.
        normal_incidence: f64,
    },
    /// Ward 1992, anisotropic, with Schlick's Fresnel term.
    Ward {
        /// Reflectance of the diffuse part.
        albedo: f64,
        /// Fresnel reflectance of the microfacets at normal incidence.
        specular: f64,
        /// Standard deviations of the slope along the tangent and across it, above 0.
        roughness: [f64; 2],
    },
    /// Ashikhmin and Shirley 2000, anisotropic, with Schlick's Fresnel term and a diffuse part reduced accordingly.
    AshikhminShirley {
        /// Reflectance of the diffuse part.
        albedo: f64,
        /// Fresnel reflectance of the microfacets at normal incidence.
        specular: f64,
        /// Phong-like exponents along the tangent and across it, at least 0.
        exponents: [f64; 2],
    },
}

/// Tolerance for a sum of reflectances above 1, because materials are in single precision.
const SINGLE: f64 = 1e-6;

fn one_way_error(found: &'static str) -> InputError {
    input_error!(
        "expected a diffuse or glossy material, found {found}: its reflectance is no function of two \
         directions"
    )
}

impl Brdf {
    /// One channel (0 red, 1 green, 2 blue) of a material's surface. Fails with [`InputError`] for mirrors and glass,
    /// and for parameters out of range. Panics if there is no such channel.
    pub fn of_surface(surface: &Surface, channel: usize) -> Result<Self, InputError> {
        let brdf = match *surface {
            Surface::Diffuse { albedo } => Self::Lambert { albedo: f64::from(albedo[channel]) },
            Surface::Glossy { albedo, specular, exponent } => Self::Phong {
                albedo: f64::from(albedo[channel]),
                specular: f64::from(specular[channel]),
                exponent: f64::from(exponent),
            },
            Surface::Mirror { .. } => return Err(one_way_error("a mirror")),
            Surface::Glass { .. } => return Err(one_way_error("glass")),
        };
        brdf.check().map(|()| brdf)
    }

    /// Checks that all parameters are in range. Fails with [`InputError`] for the first that is not.
    pub fn check(&self) -> Result<(), InputError> {
        type Range = (&'static str, fn(f64) -> bool);
        const SHARE: Range = ("a number from 0 to 1", |x| (0.0..=1.0).contains(&x));
        const BELOW_1: Range = ("a number from 0 to below 1", |x| (0.0..1.0).contains(&x));
        const SUM: Range = ("a number from 0 to 1", |x| x <= 1.0 + SINGLE);
        const WIDTH: Range = ("a number from 0.001 to below 1e9", |x| (0.001..1e9).contains(&x));
        const SCHLICK_WIDTH: Range = ("a number from 0.001 to 1", |x| (0.001..=1.0).contains(&x));
        const EXPONENT: Range = ("a number from 0 to below 1e9", |x| (0.0..1e9).contains(&x));
        let figures: &[(&str, Range, f64)] = match *self {
            Self::Lambert { albedo } => &[("albedo", SHARE, albedo)],
            Self::Phong { albedo, specular, exponent } => &[
                ("albedo", SHARE, albedo),
                ("specular reflectance", SHARE, specular),
                ("exponent", EXPONENT, exponent),
                ("sum of albedo and specular reflectance", SUM, albedo + specular),
            ],
            Self::CookTorrance { albedo, specular, roughness, normal_incidence } => &[
                ("albedo", SHARE, albedo),
                ("specular factor", SHARE, specular),
                ("roughness", WIDTH, roughness),
                ("reflectance at normal incidence", BELOW_1, normal_incidence),
            ],
            Self::Schlick { albedo, specular, roughness, isotropy, normal_incidence } => &[
                ("albedo", SHARE, albedo),
                ("specular factor", SHARE, specular),
                ("roughness", SCHLICK_WIDTH, roughness),
                ("isotropy", SCHLICK_WIDTH, isotropy),
                ("reflectance at normal incidence", SHARE, normal_incidence),
            ],
            Self::Ward { albedo, specular, roughness: [x, y] } => &[
                ("albedo", SHARE, albedo),
                ("specular reflectance", SHARE, specular),
                ("roughness", WIDTH, x),
                ("roughness", WIDTH, y),
            ],
            Self::AshikhminShirley { albedo, specular, exponents: [u, v] } => &[
                ("albedo", SHARE, albedo),
                ("specular reflectance", SHARE, specular),
                ("exponent", EXPONENT, u),
                ("exponent", EXPONENT, v),
            ],
        };
        for &(what, (expected, fits), found) in figures {
            ensure!(fits(found), "expected {expected} for the {what}, found {}", shown(found));
        }
        Ok(())
    }

    /// True if rotation around the normal has no effect.
    pub fn is_isotropic(&self) -> bool {
        match self {
            Self::Lambert { .. } | Self::Phong { .. } | Self::CookTorrance { .. } => true,
            Self::Schlick { isotropy, .. } => *isotropy == 1.0,
            Self::Ward { roughness: [x, y], .. } | Self::AshikhminShirley { exponents: [x, y], .. } => x == y,
        }
    }

    /// B(v, s) in 1/sr: radiance towards the view per irradiance from s. Both directions have length 1; 0 unless both
    /// lie above the horizon.
    pub fn value(&self, view: DVec3, s: DVec3) -> f64 {
        if !(view.z > 0.0 && s.z > 0.0) {
            return 0.0;
        }
        // Opposite directions have no half vector.
        let half = (view + s) / (view + s).length();
        match *self {
            Self::Lambert { albedo } => albedo / PI,
            Self::Phong { albedo, specular, exponent } => {
                let from_axis = (view.z * s.z - view.x * s.x - view.y * s.y).max(0.0);
                albedo / PI + specular * (exponent + 2.0) / (2.0 * PI) * pow(from_axis, exponent)
            }
            Self::CookTorrance { albedo, specular, roughness, normal_incidence } => {
                let cosine = half.dot(view).min(1.0);
                let facets = facets::beckmann(half.z, roughness) / PI;
                let groove = facets::groove(half.z, view.z.min(s.z), cosine);
                let facets = facets * groove * dielectric(normal_incidence, cosine) / (4.0 * view.z * s.z);
                albedo / PI + specular * facets
            }
            Self::Schlick { albedo, specular, roughness, isotropy, normal_incidence } => {
                let facets = facets::schlick_zenith(half.z, roughness) / PI
                    * facets::schlick_azimuth(facets::cosine_along_tangent(half), isotropy);
                let seen = facets::schlick_seen(view.z, roughness) * facets::schlick_seen(s.z, roughness);
                let facets = facets * seen * schlick(normal_incidence, half.dot(view).min(1.0)) / (4.0 * view.z * s.z);
                albedo / PI + specular * facets
            }
            Self::Ward { albedo, specular, roughness: [across, along] } => {
                let [x, y] = [half.x / across, half.y / along];
                let facets =
                    exp(-(x * x + y * y) / (half.z * half.z)) / (4.0 * PI * across * along * (view.z * s.z).sqrt());
                albedo / PI + schlick(specular, half.dot(view).min(1.0)) * facets
            }
            Self::AshikhminShirley { albedo, specular, exponents: [u, v] } => {
                let cosine = half.dot(view).min(1.0);
                let sine = half.x * half.x + half.y * half.y;
                let mean = if sine > 0.0 { (u * half.x * half.x + v * half.y * half.y) / sine } else { 0.0 };
                let facets =
                    ((u + 1.0) * (v + 1.0)).sqrt() / (8.0 * PI) * pow(half.z, mean) / (cosine * view.z.max(s.z));
                let room = |z: f64| 1.0 - fifth_power(1.0 - z / 2.0);
                let diffuse = 28.0 / (23.0 * PI) * albedo * (1.0 - specular) * room(view.z) * room(s.z);
                diffuse + schlick(specular, cosine) * facets
            }
        }
    }
}

/// Formats a number, in scientific notation if it is large.
fn shown(number: f64) -> String {
    if number.abs() < 1e16 { number.to_string() } else { format!("{number:e}") }
}

fn fifth_power(x: f64) -> f64 {
    let square = x * x;
    square * square * x
}
