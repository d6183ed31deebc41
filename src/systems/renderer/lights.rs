//! Light sampling: emitting triangles and point lights.

use std::f64::consts::PI;

use super::sampling::{DiscreteDistribution, cosine, sphere, triangle};
use super::surfel::Surfel;
use super::vector::mean;
use super::wave::SampleRng;
use crate::geom::Ray;
use crate::geom::vector::{narrow, wide};
use crate::scene::Scene;
use crate::tracer::offset::SurfacePoint;
use glam::DVec3;

/// Light sample at a point, before the visibility test.
pub(super) struct LightSample {
    /// Ray to the light, which it reaches at t = 1.
    pub(super) ray: Ray,
    pub(super) towards: DVec3,
    /// Radiance divided by the density (area lights), or irradiance perpendicular to the direction (point lights).
    pub(super) light: DVec3,
    /// Probability density over solid angle; infinite for point lights, which no other sampling strategy can hit.
    pub(super) density: f64,
}

pub(super) struct EmissionSample {
    pub(super) ray: Ray,
    /// Flux divided by the probability density; its mean over all samples is the flux of all lights.
    pub(super) power: DVec3,
}

/// Lights of a scene: its emitters, or its point lights. Scenes contain Whitted's point lights in addition to the
/// emitters that they replace; a renderer that used both would count all light twice.
pub(super) struct Lights<'a> {
    scene: &'a Scene,
    rounding: f64,
    emitters: Vec<u32>,
    /// Distribution of the emitters by power.
    table: DiscreteDistribution,
    /// Probability density over area of the points of each emitter.
    densities: Vec<f64>,
    points: Vec<(DVec3, DVec3)>,
}

impl<'a> Lights<'a> {
    /// The point lights alone.
    pub(super) fn points_of(scene: &'a Scene, rounding: f64) -> Self {
        Self::new(scene, rounding, Vec::new())
    }

    /// The emitters, or the point lights if there are no emitters.
    pub(super) fn areas_of(scene: &'a Scene, rounding: f64) -> Self {
        let emitters = scene.emitters();
        let points = if emitters.is_empty() { Self::new(scene, rounding, Vec::new()).points } else { Vec::new() };
        Self { points, ..Self::new(scene, rounding, emitters) }
    }

    fn new(scene: &'a Scene, rounding: f64, emitters: Vec<u32>) -> Self {
        let areas: Vec<f64> = emitters.iter().map(|&id| scene.mesh().area(id)).collect();
        let power = |(&id, area): (&u32, &f64)| area * mean(wide(scene.material(id).emission));
        let table = DiscreteDistribution::new(emitters.iter().zip(&areas).map(power));
        let density = |(entry, &area): (usize, &f64)| if area > 0.0 { table.chance(entry) / area } else { 0.0 };
        let densities = areas.iter().enumerate().map(density).collect();
        let points = scene.point_lights.iter().map(|light| (wide(light.position), wide(light.intensity))).collect();
        Self { scene, rounding, emitters, table, densities, points }
    }

    pub(super) fn points(&self) -> usize {
        self.points.len()
    }

    /// Samples a ray of emitted light: cosine-distributed about an emitter's normal, or uniform in all directions from
    /// a point light. `number` returns the i-th of six random numbers in [0, 1).
    pub(super) fn leaving(&self, number: impl Fn(u64) -> f64) -> Option<EmissionSample> {
        if let Some((place, radiance, density)) = self.place(number(0), [number(1), number(2)]) {
            let towards = cosine(place.normal, [number(3), number(4)]);
            let ray = Ray::new(place.lifted(towards, 0.0), narrow(towards)).ok()?;
            return Some(EmissionSample { ray, power: PI / density * radiance });
        }
        let table = DiscreteDistribution::new(self.points.iter().map(|point| mean(point.1)));
        let (light, chance) = table.draw(number(0))?;
        let (position, intensity) = self.points[light];
        let ray = Ray::new(narrow(position), narrow(sphere([number(3), number(4)]))).ok()?;
        Some(EmissionSample { ray, power: 4.0 * PI / chance * intensity })
    }

    /// Radiance that a surfel emits towards the viewer: its material's emission, on front faces only.
    pub(super) fn emitted(surfel: &Surfel<'_>) -> DVec3 {
        if surfel.front { wide(surfel.material.emission) } else { DVec3::ZERO }
    }

    /// Samples a point on an emitter by three numbers in [0, 1): the point, its radiance, and the density over area.
    pub(super) fn place(&self, which: f64, u: [f64; 2]) -> Option<(SurfacePoint, DVec3, f64)> {
        let (entry, _) = self.table.draw(which)?;
        let id = self.emitters[entry];
        let place = SurfacePoint::new(self.scene.mesh(), id, triangle(u), self.rounding)?;
        let radiance = wide(self.scene.material(id).emission);
        Some((place, radiance, self.densities[entry]))
    }

    /// Samples a point of an emitter that lights a surfel. `None` if the point is on a back face or cannot be reached.
    pub(super) fn area(&self, surfel: &Surfel<'_>, rng: SampleRng, depth: u32) -> Option<LightSample> {
        let (place, radiance, density) = self.place(rng.at(depth, 0), rng.pair(depth, 1))?;
        let offset = place.at - surfel.place.at;
        let square = offset.dot(offset);
        let towards = 1.0 / square.sqrt() * offset;
        let cosine = -towards.dot(place.normal);
        if cosine <= 0.0 || !cosine.is_finite() {
            return None;
        }
        let density = density * square / cosine;
        let ray = surfel.place.ray_to(&place)?;
        Some(LightSample { ray, towards, light: 1.0 / density * radiance, density })
    }

    /// Density over solid angle with which [`Lights::area`] samples an emitter's point that a ray has hit.
    pub(super) fn density(&self, found: &Surfel<'_>, from: DVec3) -> f64 {
        let Ok(entry) = self.emitters.binary_search(&found.triangle) else { return 0.0 };
        let offset = found.place.at - from;
        let cosine = found.view.dot(found.place.normal);
        if cosine > 0.0 { self.densities[entry] * offset.dot(offset) / cosine } else { 0.0 }
    }

    pub(super) fn point(&self, surfel: &Surfel<'_>, light: usize) -> Option<LightSample> {
        let (position, intensity) = self.points[light];
        let offset = position - surfel.place.at;
        let square = offset.dot(offset);
        let towards = 1.0 / square.sqrt() * offset;
        if !towards[0].is_finite() || towards.dot(surfel.normal) <= 0.0 {
            return None;
        }
        let ray = surfel.ray_to_point(position)?;
        Some(LightSample { ray, towards, light: 1.0 / square * intensity, density: f64::INFINITY })
    }
}
