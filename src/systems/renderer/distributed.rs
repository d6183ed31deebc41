//! Distributed ray tracing: Whitted's rays distributed at random (Cook, Porter and Carpenter 1984).

use super::Settings;
use super::counting::{CountingCaster, RayKind, WatchProgress};
use super::film::{RenderedPicture, expose};
use super::lights::Lights;
use super::lobes::{Lobes, choose_specular, specular_rays};
use super::surfel::Surfel;
use super::wave::{PathRay, Scatter, Shade};
use crate::error::InputError;
use crate::scene::{Camera, Scene};
use crate::tracer::Caster;

/// Branch of the random numbers for the second ray from glass, above the branches of gather rays (1 to 2^32).
const SECOND_RAY: u64 = 1 << 33;

/// Renders soft shadows, gloss and depth of field. A diffuse part is lit by one random point of the emitters (by the
/// point lights if the scene has no emitters). A glossy lobe sends one ray in a sampled direction, for light from
/// emitters and other surfaces. A mirror sends one ray. Glass sends both of its rays at the first hit of an eye ray,
/// otherwise one at random. `settings.depth` is the maximum number of such rays in sequence. Diffuse interreflection is
/// omitted. Fails with [`InputError`] if a setting is out of range or the caster fails.
pub fn render<'a>(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    caster: &'a mut dyn Caster,
    watch: &'a mut WatchProgress<'a>,
) -> Result<RenderedPicture, InputError> {
    let mut tracer = CountingCaster::new(caster, watch);
    let lights = Lights::areas_of(scene, settings.rounding);
    let fan = 2 + lights.points();
    expose(&mut tracer, scene, camera, settings, fan, &Distributed { settings, lights })
}

struct Distributed<'a> {
    settings: &'a Settings,
    lights: Lights<'a>,
}

impl Shade for Distributed<'_> {
    fn shade(&self, flight: &PathRay, surfel: &Surfel<'_>) -> Scatter {
        let mut scatter = Scatter::of(flight.weight * Lights::emitted(surfel));
        let more = flight.depth < self.settings.depth;
        match Lobes::of(&surfel.material.surface) {
            Some(lobes) => {
                direct(&self.lights, flight, surfel, &lobes, &mut scatter);
                if more && lobes.specular.max_element() > 0.0 {
                    gloss(flight, surfel, lobes, &mut scatter);
                }
            }
            None if more => continue_specular(flight, surfel, &mut scatter),
            None => {}
        }
        scatter
    }
}

/// Direct light: the diffuse part by one point of the emitters, both parts by the point lights, which no ray can hit.
pub(super) fn direct(lights: &Lights<'_>, flight: &PathRay, surfel: &Surfel<'_>, lobes: &Lobes, scatter: &mut Scatter) {
    let has_diffuse = lobes.albedo.max_element() > 0.0;
    let area = has_diffuse.then(|| lights.area(surfel, flight.rng, flight.depth)).flatten();
    let area = area.map(|arriving| (arriving, lobes.diffuse()));
    let points = (0..lights.points()).filter_map(|light| Some((lights.point(surfel, light)?, *lobes)));
    for (arriving, lobes) in area.into_iter().chain(points) {
        let (value, _) = lobes.evaluate(surfel, arriving.towards);
        let light = flight.weight * (value * arriving.light);
        if light.max_element() > 0.0 {
            scatter.shadows.push((arriving.ray, light));
        }
    }
}

/// Samples the glossy lobe with one ray.
pub(super) fn gloss(flight: &PathRay, surfel: &Surfel<'_>, lobes: Lobes, scatter: &mut Scatter) {
    let Some(chosen) = lobes.gloss().choose(surfel, 0.0, flight.rng.pair(flight.depth, 4)) else { return };
    let weight = flight.weight * chosen.weight;
    scatter.next.extend(surfel.ray(chosen.towards).map(|ray| flight.on(ray, RayKind::Reflection, weight)));
}

/// Continues at a mirror with one ray, and at glass with one random ray, but with both rays at the first hit of an eye
/// ray, where a random choice is visible as noise. The two rays have separate random numbers, so that their noise is
/// independent.
pub(super) fn continue_specular(flight: &PathRay, surfel: &Surfel<'_>, scatter: &mut Scatter) {
    let chosen = if flight.depth == 0 {
        specular_rays(surfel)
    } else {
        [choose_specular(surfel, flight.rng.at(flight.depth, 3)), None]
    };
    for (specular, branch) in chosen.into_iter().zip([0, SECOND_RAY]) {
        let Some(specular) = specular else { continue };
        let weight = flight.weight * specular.weight;
        if weight.max_element() > 0.0 {
            let next = surfel.ray(specular.towards).map(|ray| flight.on(ray, specular.kind, weight));
            // A gather ray keeps its density, which marks it as a gather ray.
            scatter.next.extend(next.map(|next| PathRay {
                density: flight.density,
                rng: flight.rng.branch(branch),
                ..next
            }));
        }
    }
}
