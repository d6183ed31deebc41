//! Photon mapping with final gather (Jensen, Global Illumination using Photon Maps, 1996).
//!
//! Two maps are filled from the lights. The *global* map holds every landing on a diffuse or glossy surface; the
//! *caustic* map those of light that met nothing but mirrors and glass before. What the eye sees of a diffuse part is
//! then the sum of three that share no path: light straight from the lights (a shadow ray), caustics (the caustic map's
//! density), and light by other diffuse and glossy surfaces (gather rays, which end at the next such surface in the
//! global map's density, and see no light themselves). Glossy lobes, mirrors and glass send rays on as in
//! [`super::distributed`].
//!
//! Densities are taken over disks of finite size, so this is the one renderer whose mean is not the rendering
//! equation's: it blurs within [`Photons::radius`], and darkens where a disk hangs over an edge.

mod emit;

use super::counting::{CountingCaster, RayKind, WatchProgress};
use super::film::{RenderedPicture, expose};
use super::lights::Lights;
use super::lobes::Lobes;
use super::photon_map::{Photon, PhotonMap};
use super::sampling::cosine;
use super::surfel::Surfel;
use super::wave::{PathRay, Scatter, Shade};
use super::{RenderError, Settings, distributed};
use crate::geom::Hit;
use crate::geom::vector::wide;
use crate::scene::{Camera, Scene};
use crate::tracer::Caster;
use glam::DVec3;

/// The least cosine by which a photon's flux is turned back into what a shading normal makes of it.
const LEAST_COSINE: f64 = 0.01;

/// How photons are shot and counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photons {
    /// Photons shot for the global map.
    pub global: u32,
    /// Photons shot for the caustic map.
    pub caustic: u32,
    /// Nearest photons that an estimate takes.
    pub nearest: u32,
    /// How far an estimate looks at most, in units of the scene.
    pub radius: f64,
    /// Gather rays of each diffuse hit of a sample; 0 shows the global map itself.
    pub gather: u32,
}

impl Photons {
    /// 100,000 photons for each map, 60 nearest within 1/20 of the scene's diagonal, 16 gather rays.
    pub fn for_scene(scene: &Scene) -> Self {
        let diagonal = scene.mesh().bounds().map_or(1.0, |[low, high]| (wide(high) - wide(low)).length());
        Self { global: 100_000, caustic: 100_000, nearest: 60, radius: diagonal / 20.0, gather: 16 }
    }

    fn checked(&self) -> Result<(), RenderError> {
        if self.radius > 0.0 && self.radius.is_finite() {
            return Ok(());
        }
        let found = self.radius.to_string();
        Err(RenderError::Settings { what: "the radius of photon estimates", expected: "a number above 0", found })
    }
}

/// Renders with photon maps. `settings.depth` is the most surfaces that a photon meets, and the most rays that follow
/// each other from the eye.
///
/// # Errors
/// [`RenderError`] if the settings make no sense or the caster fails.
pub fn render<'a>(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    photons: &Photons,
    caster: &'a mut dyn Caster,
    watch: &'a mut WatchProgress<'a>,
) -> Result<RenderedPicture, RenderError> {
    settings.checked()?;
    photons.checked()?;
    let mut tracer = CountingCaster::new(caster, watch);
    let lights = Lights::areas_of(scene, settings.rounding);
    let shot = |count, caustic| emit::Shot { scene, settings, lights: &lights, count, caustic };
    let global = PhotonMap::new(shot(photons.global, false).landed(&mut tracer)?);
    let caustic = PhotonMap::new(shot(photons.caustic, true).landed(&mut tracer)?);
    let fan = 2 + photons.gather as usize + lights.points();
    let shader = Gathering { scene, settings, photons, global: &global, caustic: &caustic, lights: &lights };
    expose(&mut tracer, camera, settings, fan, &shader)
}

struct Gathering<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    photons: &'a Photons,
    global: &'a PhotonMap,
    caustic: &'a PhotonMap,
    lights: &'a Lights<'a>,
}

impl Shade for Gathering<'_> {
    fn shade(&self, flight: &PathRay, hit: Option<Hit>) -> Scatter {
        let Some(surfel) = hit.and_then(|hit| Surfel::new(self.scene, self.settings.rounding, &flight.ray, hit)) else {
            return Scatter::of(flight.weight * wide(self.settings.background));
        };
        // Gather rays carry a density. They see no lights: shadow rays and the caustic map have counted those.
        let gathers = flight.density.is_some();
        let seen = if gathers { DVec3::ZERO } else { Lights::seen(&surfel) };
        let mut scatter = Scatter::of(flight.weight * seen);
        let more = flight.depth < self.settings.depth;
        match Lobes::of(&surfel.material.surface) {
            Some(lobes) if gathers => {
                let light = self.estimate(self.global, &surfel, &lobes);
                scatter.light += flight.weight * light;
            }
            Some(lobes) => self.scatter(flight, &surfel, lobes, more, &mut scatter),
            None if more => distributed::go_on(flight, &surfel, &mut scatter),
            None => {}
        }
        scatter
    }
}

impl Gathering<'_> {
    fn scatter(&self, flight: &PathRay, surfel: &Surfel<'_>, lobes: Lobes, more: bool, scatter: &mut Scatter) {
        let diffuse = lobes.diffuse();
        if lobes.albedo.max_element() > 0.0 {
            let landed = if self.photons.gather == 0 {
                self.estimate(self.global, surfel, &diffuse)
            } else {
                distributed::direct(self.lights, flight, surfel, &lobes, scatter);
                self.gather(flight, surfel, &lobes, scatter);
                self.estimate(self.caustic, surfel, &diffuse)
            };
            scatter.light += flight.weight * landed;
        }
        if more && lobes.specular.max_element() > 0.0 {
            distributed::gloss(flight, surfel, lobes, scatter);
        }
    }

    /// Rays by the cosine, so that each weighs the albedo over their number.
    fn gather(&self, flight: &PathRay, surfel: &Surfel<'_>, lobes: &Lobes, scatter: &mut Scatter) {
        let rays = self.photons.gather;
        let weight = 1.0 / f64::from(rays) * (flight.weight * lobes.albedo);
        for ray in 0..u64::from(rays) {
            let dice = flight.dice.branch(1 + ray);
            let towards = cosine(surfel.shading, dice.pair(flight.depth, 4));
            if towards.dot(surfel.normal) <= 0.0 {
                continue;
            }
            let density = Some(towards.dot(surfel.shading).max(0.0));
            let next = surfel.ray(towards).map(|ray| flight.on(ray, RayKind::Gather, weight));
            scatter.next.extend(next.map(|next| PathRay { density, dice, ..next }));
        }
    }

    /// Radiance by a map. A photon's flux is per area of the triangle; the surface scatters it by its shading normal.
    fn estimate(&self, map: &PhotonMap, surfel: &Surfel<'_>, lobes: &Lobes) -> DVec3 {
        let Photons { nearest, radius, .. } = *self.photons;
        map.density(surfel.place.at, surfel.normal, nearest as usize, radius, |photon: &Photon| {
            let (value, _) = lobes.evaluate(surfel, photon.from);
            let cosine = photon.from.dot(surfel.normal).max(LEAST_COSINE);
            photon.power * (1.0 / cosine * value)
        })
    }
}
