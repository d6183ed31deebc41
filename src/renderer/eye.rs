//! Eye rays alone: what is seen where, in the light of a light at the eye.

use super::counting::{CountingCaster, WatchProgress};
use super::film::{RenderedPicture, expose};
use super::surfel::Surfel;
use super::wave::{PathRay, Scatter, Shade};
use super::{RenderError, Settings};
use crate::geom::Hit;
use crate::geom::vector::wide;
use crate::scene::{Camera, Scene, Surface};
use crate::tracer::Caster;

/// Casts eye rays. A surface shows its own colour (of mirrors and glass what they let pass) times the cosine to the
/// eye, and what it emits on top; a back face shows half of it, so that holes and turned triangles are seen. No other
/// rays are cast.
///
/// # Errors
/// [`RenderError`] if the settings make no sense or the caster fails.
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
        Scatter::of(facing * color + super::lights::Lights::seen(&surfel))
    }
}
