//! Eye rays alone: visible surfaces, lit by a light at the eye.

use glam::DVec3;

use super::Settings;
use super::counting::{CountingCaster, WatchProgress};
use super::film::{RenderedPicture, expose};
use super::lights::Lights;
use super::surfel::Surfel;
use super::wave::{PathRay, Scatter, Shade};
use crate::error::InputError;
use crate::geom::vector::wide;
use crate::scene::{Camera, Scene, Surface};
use crate::tracer::Caster;

/// Renders with eye rays only. A pixel is the surface's albedo (for mirrors and glass the reflectance or transmittance)
/// times the cosine to the eye, plus its emission; a back face has half of this value, so that holes and flipped
/// triangles are visible. Fails with [`InputError`] if a setting is out of range or the caster fails.
pub fn render<'a>(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    caster: &'a mut dyn Caster,
    watch: &'a mut WatchProgress<'a>,
) -> Result<RenderedPicture, InputError> {
    let mut tracer = CountingCaster::new(caster, watch);
    expose(&mut tracer, scene, camera, settings, 1, &Eye)
}

struct Eye;

impl Shade for Eye {
    fn shade(&self, _: &PathRay, surfel: &Surfel<'_>) -> Scatter {
        let facing = surfel.shading.dot(surfel.view).max(0.0) * if surfel.front { 1.0 } else { 0.5 };
        Scatter::of(facing * albedo(&surfel.material.surface) + Lights::emitted(surfel))
    }
}

/// Total reflectance or transmittance.
pub(super) fn albedo(surface: &Surface) -> DVec3 {
    match *surface {
        Surface::Diffuse { albedo } => wide(albedo),
        Surface::Glossy { albedo, specular, .. } => wide(albedo) + wide(specular),
        Surface::Mirror { reflectance } => wide(reflectance),
        Surface::Glass { transmittance, .. } => wide(transmittance),
    }
}
