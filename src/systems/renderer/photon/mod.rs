//! Photon mapping with final gather (Jensen, Global Illumination using Photon Maps, 1996).
//!
//! The lights fill two maps. The *global* map stores every photon hit on a diffuse or glossy surface; the *caustic* map
//! stores only hits of photons that met only mirrors and glass before. The radiance of a diffuse part is the sum of
//! three terms that share no path: direct light (a shadow ray), caustics (the caustic map's density), and indirect
//! light (gather rays, which end with the global map's density at the next diffuse or glossy surface, and see no
//! emitters). Glossy lobes, mirrors and glass send further rays as in [`super::distributed`]; a glossy lobe also
//! samples point lights by shadow rays and the caustic map, because no ray hits a point.
//!
//! Densities are estimated over disks of finite size, so this renderer, unlike the others, is biased: it blurs within
//! [`Photons::radius`], and darkens where a disk extends over an edge.

mod emit;

use super::counting::{CountingCaster, RayKind, WatchProgress};
use super::film::{RenderedPicture, expose};
use super::lights::Lights;
use super::lobes::Lobes;
use super::photon_map::{Photon, PhotonMap};
use super::sampling::cosine;
use super::surfel::Surfel;
use super::wave::{PathRay, Scatter, Shade};
use super::{Settings, distributed};
use crate::error::InputError;
use crate::geom::vector::wide;
use crate::renderer::settings::settings_error;
use crate::scene::{Camera, Scene};
use crate::tracer::Caster;
use glam::DVec3;

/// Minimum cosine in the conversion of a photon's flux to the shading normal.
const LEAST_COSINE: f64 = 0.01;

/// Parameters of photon mapping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photons {
    /// Number of photons emitted for the global map.
    pub global: u32,
    /// Number of photons emitted for the caustic map.
    pub caustic: u32,
    /// Maximum number of nearest photons per estimate, at least 2; the farthest determines the area.
    pub nearest: u32,
    /// Maximum radius of an estimate, in scene units.
    pub radius: f64,
    /// Gather rays per diffuse hit of a sample; 0 displays the global map directly.
    pub gather: u32,
}

impl Photons {
    /// Default parameters: 100,000 photons per map, 60 nearest within 1/20 of the scene's diagonal, 16 gather rays.
    pub fn for_scene(scene: &Scene) -> Self {
        let diagonal = scene.mesh().bounds().map_or(1.0, |[low, high]| (wide(high) - wide(low)).length());
        Self { global: 100_000, caustic: 100_000, nearest: 60, radius: diagonal / 20.0, gather: 16 }
    }

    fn checked(&self) -> Result<(), InputError> {
        if !(self.radius > 0.0 && self.radius.is_finite()) {
            let (what, found) = ("the radius of photon estimates", self.radius.to_string());
            return Err(settings_error(what, "a number above 0", found));
        }
        if self.nearest < 2 {
            let (what, found) = ("the nearest photons of an estimate", self.nearest.to_string());
            return Err(settings_error(what, "at least 2", found));
        }
        Ok(())
    }
}

/// Renders with photon maps. `settings.depth` is the maximum number of hits of a photon, and of rays in sequence from
/// the eye. Fails with [`InputError`] if a setting is out of range or the caster fails.
pub fn render<'a>(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    photons: &Photons,
    caster: &'a mut dyn Caster,
    watch: &'a mut WatchProgress<'a>,
) -> Result<RenderedPicture, InputError> {
    settings.checked()?;
    photons.checked()?;
    let mut tracer = CountingCaster::new(caster, watch);
    let lights = Lights::areas_of(scene, settings.rounding);
    let emission = |count, caustic| emit::PhotonEmission { scene, settings, lights: &lights, count, caustic };
    let global = PhotonMap::new(emission(photons.global, false).landed(&mut tracer)?);
    let caustic = PhotonMap::new(emission(photons.caustic, true).landed(&mut tracer)?);
    let fan = 2 + photons.gather as usize + lights.points();
    let shader = Gathering { settings, photons, global: &global, caustic: &caustic, lights: &lights };
    expose(&mut tracer, scene, camera, settings, fan, &shader)
}

struct Gathering<'a> {
    settings: &'a Settings,
    photons: &'a Photons,
    global: &'a PhotonMap,
    caustic: &'a PhotonMap,
    lights: &'a Lights<'a>,
}

impl Shade for Gathering<'_> {
    fn shade(&self, flight: &PathRay, surfel: &Surfel<'_>) -> Scatter {
        // Gather rays carry a density. They see no lights, because shadow rays and the caustic map have counted them.
        let gathers = flight.density.is_some();
        let seen = if gathers { DVec3::ZERO } else { Lights::emitted(surfel) };
        let mut scatter = Scatter::of(flight.weight * seen);
        let more = flight.depth < self.settings.depth;
        match Lobes::of(&surfel.material.surface) {
            Some(lobes) if gathers => {
                let light = self.estimate(self.global, surfel, &lobes);
                scatter.light += flight.weight * light;
            }
            Some(lobes) => self.scatter(flight, surfel, lobes, more, &mut scatter),
            None if more => distributed::continue_specular(flight, surfel, &mut scatter),
            None => {}
        }
        scatter
    }
}

impl Gathering<'_> {
    fn scatter(&self, flight: &PathRay, surfel: &Surfel<'_>, lobes: Lobes, more: bool, scatter: &mut Scatter) {
        // Without gather rays, the global map contains all light of the diffuse part.
        let mapped = self.photons.gather == 0;
        let lit = if mapped { lobes.gloss() } else { lobes };
        distributed::direct(self.lights, flight, surfel, &lit, scatter);
        // A glossy lobe's ray finds emitters behind mirrors and glass, but no point light.
        let caustic = if self.lights.points() > 0 { lit } else { lit.diffuse() };
        scatter.light += flight.weight * self.estimate(self.caustic, surfel, &caustic);
        if mapped {
            scatter.light += flight.weight * self.estimate(self.global, surfel, &lobes.diffuse());
        } else if lobes.albedo.max_element() > 0.0 {
            self.gather(flight, surfel, &lobes, scatter);
        }
        if more && lobes.specular.max_element() > 0.0 {
            distributed::gloss(flight, surfel, lobes, scatter);
        }
    }

    /// Emits cosine-distributed gather rays; each is weighted by the albedo divided by their number.
    fn gather(&self, flight: &PathRay, surfel: &Surfel<'_>, lobes: &Lobes, scatter: &mut Scatter) {
        let rays = self.photons.gather;
        let weight = 1.0 / f64::from(rays) * (flight.weight * lobes.albedo);
        for ray in 0..u64::from(rays) {
            let rng = flight.rng.branch(1 + ray);
            let towards = cosine(surfel.shading, rng.pair(flight.depth, 4));
            if towards.dot(surfel.normal) <= 0.0 {
                continue;
            }
            let density = Some(towards.dot(surfel.shading).max(0.0));
            let next = surfel.ray(towards).map(|ray| flight.on(ray, RayKind::Gather, weight));
            scatter.next.extend(next.map(|next| PathRay { density, rng, ..next }));
        }
    }

    /// Radiance estimate. A photon's flux is per area of the triangle; the shading normal determines scattering.
    fn estimate(&self, map: &PhotonMap, surfel: &Surfel<'_>, lobes: &Lobes) -> DVec3 {
        if lobes.albedo.max(lobes.specular).max_element() <= 0.0 {
            return DVec3::ZERO;
        }
        let Photons { nearest, radius, .. } = *self.photons;
        map.density(surfel.place.at, surfel.normal, nearest as usize, radius, |photon: &Photon| {
            let (value, _) = lobes.evaluate(surfel, photon.from);
            let cosine = photon.from.dot(surfel.normal).max(LEAST_COSINE);
            photon.power * (1.0 / cosine * value)
        })
    }
}
