//! Path tracing: the rendering equation by random walks (Kajiya 1986), unbiased.

use super::Settings;
use super::counting::{CountingCaster, RayKind, WatchProgress};
use super::film::{RenderedPicture, expose};
use super::lights::{LightSample, Lights};
use super::lobes::{Lobes, choose_specular};
use super::surfel::Surfel;
use super::wave::{PathRay, Scatter, Shade};
use crate::error::InputError;
use crate::geom::vector::wide;
use crate::scene::{Camera, Scene};
use crate::tracer::Caster;
use glam::DVec3;

/// Number of hits before Russian roulette begins.
const SAFE: u32 = 3;
/// Minimum survival probability, so that a weight grows at most by a factor of 20 per hit.
const LEAST_CHANCE: f64 = 0.05;

/// Sampling strategy for direct light from emitters. All three have the same mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direct {
    /// Only by rays that happen to hit an emitter.
    Walk,
    /// Only by points sampled on the emitters (next-event estimation), except at mirrors and glass.
    Emitters,
    /// By both, weighted by their densities (the balance heuristic, Veach and Guibas 1995).
    #[default]
    Both,
}

/// Renders by path tracing. `settings.depth` is the maximum number of surfaces between eye and light: 0 shows only
/// emitters, 1 adds direct light. After three hits, paths are subject to Russian roulette, which does not change the
/// mean. Fails with [`InputError`] if a setting is out of range or the caster fails.
pub fn render<'a>(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    direct: Direct,
    caster: &'a mut dyn Caster,
    watch: &'a mut WatchProgress<'a>,
) -> Result<RenderedPicture, InputError> {
    let mut tracer = CountingCaster::new(caster, watch);
    let lights = Lights::areas_of(scene, settings.rounding);
    let fan = 2 + lights.points();
    expose(&mut tracer, scene, camera, settings, fan, &Paths { settings, lights, direct })
}

struct Paths<'a> {
    settings: &'a Settings,
    lights: Lights<'a>,
    direct: Direct,
}

impl Shade for Paths<'_> {
    fn shade(&self, flight: &PathRay, surfel: &Surfel<'_>) -> Scatter {
        let share = self.share_of_walk(flight, surfel);
        let mut scatter = Scatter::of(share * (flight.weight * Lights::emitted(surfel)));
        if flight.depth < self.settings.depth {
            match Lobes::of(&surfel.material.surface) {
                Some(lobes) => self.scatter(flight, surfel, &lobes, &mut scatter),
                None => self.pass(flight, surfel, &mut scatter),
            }
        }
        scatter
    }
}

impl Paths<'_> {
    /// MIS weight of an emitter that the random walk has hit.
    fn share_of_walk(&self, flight: &PathRay, surfel: &Surfel<'_>) -> f64 {
        match (flight.density, self.direct) {
            // After the eye, a mirror or glass, no other strategy finds the emitter.
            (None, _) | (_, Direct::Walk) => 1.0,
            (Some(_), Direct::Emitters) => 0.0,
            (Some(walk), Direct::Both) => {
                let chosen = self.lights.density(surfel, wide(flight.ray.origin()));
                walk / (walk + chosen)
            }
        }
    }

    fn scatter(&self, flight: &PathRay, surfel: &Surfel<'_>, lobes: &Lobes, scatter: &mut Scatter) {
        let rng = flight.rng;
        if self.direct != Direct::Walk
            && let Some(arriving) = self.lights.area(surfel, rng, flight.depth)
        {
            self.lit(flight, surfel, lobes, &arriving, scatter);
        }
        for light in 0..self.lights.points() {
            if let Some(arriving) = self.lights.point(surfel, light) {
                self.lit(flight, surfel, lobes, &arriving, scatter);
            }
        }
        let Some(chosen) = lobes.choose(surfel, rng.at(flight.depth, 3), rng.pair(flight.depth, 4)) else { return };
        // The ray after the last surface can only contribute emission.
        if flight.depth + 1 == self.settings.depth && self.direct == Direct::Emitters && !self.sees_background() {
            return;
        }
        let weight = flight.weight * chosen.weight;
        if let Some(mut next) = self.continue_path(flight, surfel, chosen.towards, RayKind::Gather, weight) {
            next.density = Some(chosen.density);
            scatter.next.push(next);
        }
    }

    fn sees_background(&self) -> bool {
        self.settings.background.iter().any(|&channel| channel > 0.0)
    }

    fn lit(&self, flight: &PathRay, surfel: &Surfel<'_>, lobes: &Lobes, arriving: &LightSample, scatter: &mut Scatter) {
        let (value, walk) = lobes.evaluate(surfel, arriving.towards);
        // Point lights have an infinite density: no other strategy finds them, and their MIS weight is 1.
        let share = match self.direct {
            Direct::Both if arriving.density.is_finite() => arriving.density / (arriving.density + walk),
            _ => 1.0,
        };
        let light = share * (flight.weight * (value * arriving.light));
        if light.max_element() > 0.0 {
            scatter.shadows.push((arriving.ray, light));
        }
    }

    fn pass(&self, flight: &PathRay, surfel: &Surfel<'_>, scatter: &mut Scatter) {
        let Some(specular) = choose_specular(surfel, flight.rng.at(flight.depth, 3)) else { return };
        let weight = flight.weight * specular.weight;
        scatter.next.extend(self.continue_path(flight, surfel, specular.towards, specular.kind, weight));
    }

    fn continue_path(
        &self,
        flight: &PathRay,
        surfel: &Surfel<'_>,
        towards: DVec3,
        kind: RayKind,
        weight: DVec3,
    ) -> Option<PathRay> {
        let chance = if flight.depth < SAFE { 1.0 } else { weight.max_element().clamp(LEAST_CHANCE, 1.0) };
        if weight.max_element() <= 0.0 || flight.rng.at(flight.depth, 6) >= chance {
            return None;
        }
        Some(flight.on(surfel.ray(towards)?, kind, 1.0 / chance * weight))
    }
}
