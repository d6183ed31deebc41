//! Whitted's ray tracing: point lights, hard shadows, mirrors, glass (An Improved Illumination Model for Shaded
//! Display, 1980).

use super::Settings;
use super::counting::{CountingCaster, WatchProgress};
use super::distributed::direct;
use super::film::{RenderedPicture, expose};
use super::lights::Lights;
use super::lobes::{Lobes, specular_rays};
use super::surfel::Surfel;
use super::wave::{PathRay, Scatter, Shade};
use crate::error::InputError;
use crate::scene::{Camera, Scene};
use crate::tracer::Caster;

/// Minimum weight of a branch of the ray tree (Hall's adaptive depth): half a step of an 8-bit display.
const LEAST_WEIGHT: f64 = 1.0 / 512.0;

/// Renders after Whitted. Diffuse and glossy surfaces are lit by the scene's point lights, each with a shadow ray;
/// mirrors and glass send further rays, at most `settings.depth` in sequence. Emitters are visible, directly and in
/// mirrors, but do not illuminate.
pub fn render<'a>(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    caster: &'a mut dyn Caster,
    watch: &'a mut WatchProgress<'a>,
) -> Result<RenderedPicture, InputError> {
    let mut tracer = CountingCaster::new(caster, watch);
    let lights = Lights::points_of(scene, settings.rounding);
    // A ray may split in two at each glass surface, but few do.
    let fan = 2 + lights.points();
    expose(&mut tracer, scene, camera, settings, fan, &Whitted { settings, lights })
}

struct Whitted<'a> {
    settings: &'a Settings,
    lights: Lights<'a>,
}

impl Shade for Whitted<'_> {
    fn shade(&self, flight: &PathRay, surfel: &Surfel<'_>) -> Scatter {
        let mut scatter = Scatter::of(flight.weight * Lights::emitted(surfel));
        match Lobes::of(&surfel.material.surface) {
            Some(lobes) => direct(&self.lights, flight, surfel, &lobes, &mut scatter),
            None if flight.depth < self.settings.depth => continue_specular(flight, surfel, &mut scatter),
            None => {}
        }
        scatter
    }
}

fn continue_specular(flight: &PathRay, surfel: &Surfel<'_>, scatter: &mut Scatter) {
    for specular in specular_rays(surfel).into_iter().flatten() {
        let weight = flight.weight * specular.weight;
        if weight.max_element() < LEAST_WEIGHT {
            continue;
        }
        scatter.next.extend(surfel.ray(specular.towards).map(|ray| flight.on(ray, specular.kind, weight)));
    }
}
