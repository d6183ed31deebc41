//! Eye rays alone: visible surfaces, lit by a light at the eye.

use super::counting::{CountingCaster, WatchProgress};
use super::film::{RenderedPicture, expose};
use super::surfel::Surfel;
use super::wave::{PathRay, Scatter, Shade};
use super::{RenderError, Settings};
use crate::geom::Hit;
use crate::geom::vector::wide;
use crate::scene::{Camera, Scene, Surface};
use crate::tracer::Caster;

/// Renders with eye rays only. A pixel is the surface's albedo (of mirrors and glass their reflectance or
/// transmittance) times the cosine to the eye, plus its emission; a back face shows half of that, so that holes and
/// flipped triangles are visible.
///
/// # Errors
/// [`RenderError`] if a setting is out of range or the caster fails.
pub fn render<'a>(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    caster: &'a mut dyn Caster,
    watch: &'a mut WatchProgress<'a>,
) -> Result<RenderedPicture, RenderError> {
    let mut tracer = CountingCaster::new(caster, watch);
    expose(&mut tracer, camera, settings, 1, &Eye { scene, settings })
}

struct Eye<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
}

impl Shade for Eye<'_> {
    fn shade(&self, flight: &PathRay, hit: Option<Hit>) -> Scatter {
        let Some(surfel) = hit.and_then(|hit| Surfel::new(self.scene, self.settings.rounding, &flight.ray, hit)) else {
            return Scatter::of(wide(self.settings.background));
        };
        let color = match surfel.material.surface {
            Surface::Diffuse { albedo } => wide(albedo),
            Surface::Glossy { albedo, specular, .. } => wide(albedo) + wide(specular),
            Surface::Mirror { reflectance } => wide(reflectance),
            Surface::Glass { transmittance, .. } => wide(transmittance),
        };
        let facing = surfel.shading.dot(surfel.view).max(0.0) * if surfel.front { 1.0 } else { 0.5 };
        Scatter::of(facing * color + super::lights::Lights::emitted(&surfel))
    }
}
