//! Scattering at surfaces: lobes that can be evaluated (diffuse, glossy) and specular rays (mirror, glass).

use std::f64::consts::PI;

use super::counting::RayKind;
use super::sampling::{cosine, lobe};
use super::surfel::Surfel;
use super::vector::mean;
use crate::elementary::pow;
use crate::fresnel::reflectance;
use crate::geom::vector::{unit, wide};
use crate::scene::Surface;
use glam::DVec3;

/// Diffuse part and Phong lobe about the mirror direction, normalised after Lafortune and Willems (1994): `f = albedo /
/// pi + specular (n + 2) / (2 pi) cos^n`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lobes {
    pub(super) albedo: DVec3,
    pub(super) specular: DVec3,
    pub(super) exponent: f64,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct LobeSample {
    pub(super) towards: DVec3,
    /// `f cos / density`.
    pub(super) weight: DVec3,
    /// Density over solid angle, of both lobes together.
    pub(super) density: f64,
}

impl Lobes {
    /// Returns the lobes of a surface; `None` for mirrors and glass, which are specular.
    pub(super) fn of(surface: &Surface) -> Option<Self> {
        match *surface {
            Surface::Diffuse { albedo } => Some(Self { albedo: wide(albedo), specular: DVec3::ZERO, exponent: 1.0 }),
            Surface::Glossy { albedo, specular, exponent } => {
                let exponent = f64::from(exponent).max(f64::MIN_POSITIVE);
                Some(Self { albedo: wide(albedo), specular: wide(specular), exponent })
            }
            Surface::Mirror { .. } | Surface::Glass { .. } => None,
        }
    }

    pub(super) fn diffuse(self) -> Self {
        Self { specular: DVec3::ZERO, ..self }
    }

    pub(super) fn gloss(self) -> Self {
        Self { albedo: DVec3::ZERO, ..self }
    }

    fn chance_of_gloss(&self) -> f64 {
        let (matt, gloss) = (mean(self.albedo), mean(self.specular));
        if gloss > 0.0 { gloss / (matt + gloss) } else { 0.0 }
    }

    /// Returns `f cos`, and the density with which [`Lobes::choose`] samples the direction. Both are zero if the
    /// direction is on the other side of the triangle, or below the shading normal's horizon.
    pub(super) fn evaluate(&self, surfel: &Surfel<'_>, towards: DVec3) -> (DVec3, f64) {
        let cos = towards.dot(surfel.shading);
        if cos <= 0.0 || towards.dot(surfel.normal) <= 0.0 {
            return (DVec3::ZERO, 0.0);
        }
        let mut value = cos / PI * self.albedo;
        let gloss = self.chance_of_gloss();
        let mut density = (1.0 - gloss) * cos / PI;
        if gloss > 0.0 {
            let from_axis = reflected(surfel.view, surfel.shading).dot(towards);
            if from_axis > 0.0 {
                let shape = pow(from_axis, self.exponent) / (2.0 * PI);
                value += (self.exponent + 2.0) * shape * cos * self.specular;
                density += gloss * (self.exponent + 1.0) * shape;
            }
        }
        (value, density)
    }

    /// Samples a direction by three numbers in [0, 1); `None` if the light is absorbed.
    pub(super) fn choose(&self, surfel: &Surfel<'_>, which: f64, u: [f64; 2]) -> Option<LobeSample> {
        let towards = if which < self.chance_of_gloss() {
            lobe(reflected(surfel.view, surfel.shading), self.exponent, u)
        } else {
            cosine(surfel.shading, u)
        };
        let (value, density) = self.evaluate(surfel, towards);
        (density > 0.0).then(|| LobeSample { towards, weight: 1.0 / density * value, density })
    }
}

/// Specular ray from a mirror or glass, with its weight.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpecularRay {
    pub(super) towards: DVec3,
    pub(super) weight: DVec3,
    pub(super) kind: RayKind,
    /// Probability of this ray if one of several rays is chosen.
    pub(super) probability: f64,
    /// Additional factor of a photon's flux: the squared ratio of indices at a boundary that the photon passes,
    /// otherwise 1. With it, irradiance too is divided by the squared index.
    pub(super) flux_scale: f64,
}

/// Returns the specular rays from a mirror (one) or glass (one under total internal reflection, otherwise two); no rays
/// from other surfaces.
///
/// Rays carry radiance divided by the squared index of refraction, which is invariant at a boundary (Nicodemus 1963).
/// So a boundary needs no factor, and emission and scattering inside glass are as in air.
pub(super) fn specular_rays(surfel: &Surfel<'_>) -> [Option<SpecularRay>; 2] {
    let mirrored = |weight, probability| SpecularRay {
        towards: mirror_direction(surfel),
        weight,
        kind: RayKind::Reflection,
        probability,
        flux_scale: 1.0,
    };
    match surfel.material.surface {
        Surface::Diffuse { .. } | Surface::Glossy { .. } => [None, None],
        Surface::Mirror { reflectance } => [Some(mirrored(wide(reflectance), 1.0)), None],
        Surface::Glass { index, transmittance } => {
            let index = f64::from(index);
            let ratio = if surfel.front { 1.0 / index } else { index };
            let share = reflectance(surfel.view.dot(surfel.shading), ratio);
            let Some(towards) = through(surfel, ratio) else { return [Some(mirrored(DVec3::ONE, 1.0)), None] };
            let weight = (1.0 - share) * wide(transmittance);
            let probability = 1.0 - share;
            let refracted =
                SpecularRay { towards, weight, kind: RayKind::Refraction, probability, flux_scale: ratio * ratio };
            let reflected = (share > 0.0).then(|| mirrored(DVec3::splat(share), share));
            [Some(refracted), reflected]
        }
    }
}

/// Chooses one of the specular rays by a number in [0, 1); its weight is divided by its probability.
pub(super) fn choose_specular(surfel: &Surfel<'_>, u: f64) -> Option<SpecularRay> {
    let [first, second] = specular_rays(surfel);
    let first = first?;
    let specular = match second {
        Some(second) if u >= first.probability => second,
        _ => first,
    };
    Some(SpecularRay { weight: 1.0 / specular.probability * specular.weight, ..specular })
}

/// Mirrors a direction that points away from the surface.
fn reflected(away: DVec3, normal: DVec3) -> DVec3 {
    2.0 * away.dot(normal) * normal - away
}

/// Snell's law: `away` points back along the ray, `normal` to the same side. `None` under total internal reflection.
fn refracted(away: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    let cosine = away.dot(normal);
    let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if square <= 0.0 {
        return None;
    }
    unit(-ratio * away + (ratio * cosine - square.sqrt()) * normal)
}

/// Mirror direction about the shading normal, or the triangle's normal if it would lead through the triangle.
fn mirror_direction(surfel: &Surfel<'_>) -> DVec3 {
    let smooth = reflected(surfel.view, surfel.shading);
    if smooth.dot(surfel.normal) > 0.0 { smooth } else { reflected(surfel.view, surfel.normal) }
}

fn through(surfel: &Surfel<'_>, ratio: f64) -> Option<DVec3> {
    let smooth = refracted(surfel.view, surfel.shading, ratio)?;
    if smooth.dot(surfel.normal) < 0.0 { Some(smooth) } else { refracted(surfel.view, surfel.normal, ratio) }
}
