//! Breadth-first evaluation: all rays of a bundle, then all rays that they spawn, until no ray is left.

use glam::DVec3;
use rayon::prelude::*;

use super::Settings;
use super::counting::{CountingCaster, RayKind};
use super::surfel::Surfel;
use crate::error::InputError;
use crate::geom::random::CounterRng;
use crate::geom::vector::wide;
use crate::geom::{Hit, Ray};
use crate::scene::Scene;
use crate::tracer::{CastError, is_occluder};

/// Random numbers of one sample of one pixel, along one branch of its tree of rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct SampleRng {
    stream: CounterRng,
    pixel: u64,
    sample: u64,
    branch: u64,
}

/// Random numbers per sample before its first hit: position in the pixel and on the lens.
const NUMBERS_BEFORE_HITS: u64 = 8;
/// Random numbers per hit.
const NUMBERS_PER_HIT: u64 = 16;

impl SampleRng {
    pub(super) const fn new(seed: u64, pixel: u64, sample: u64) -> Self {
        Self { stream: CounterRng::new(seed), pixel, sample, branch: 0 }
    }

    /// Returns the random numbers of one of several rays that leave a hit; branch 0 continues the hit's random numbers.
    pub(super) const fn branch(self, branch: u64) -> Self {
        Self { branch: self.branch + branch, ..self }
    }

    pub(super) fn before(self, n: u64) -> f64 {
        self.stream.unit(self.pixel, self.sample, n)
    }

    /// Returns the n-th number (n below 16) at a hit after `depth` earlier hits.
    pub(super) fn at(self, depth: u32, n: u64) -> f64 {
        self.stream.unit(
            self.pixel,
            self.sample,
            (self.branch << 24) + NUMBERS_BEFORE_HITS + NUMBERS_PER_HIT * u64::from(depth) + n,
        )
    }

    pub(super) fn pair(self, depth: u32, n: u64) -> [f64; 2] {
        [self.at(depth, n), self.at(depth, n + 1)]
    }
}

/// Ray in flight.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathRay {
    pub(super) ray: Ray,
    pub(super) kind: RayKind,
    /// Index, within the chunk, of the sample to which the ray's radiance is added.
    pub(super) slot: u32,
    /// Throughput: factor of the radiance along the ray.
    pub(super) weight: DVec3,
    /// Number of hits before this one.
    pub(super) depth: u32,
    /// Probability density of the ray's direction over solid angle; `None` if the direction was not sampled.
    pub(super) density: Option<f64>,
    pub(super) rng: SampleRng,
}

impl PathRay {
    pub(super) fn eye(ray: Ray, slot: u32, rng: SampleRng) -> Self {
        Self { ray, kind: RayKind::Eye, slot, weight: DVec3::ONE, depth: 0, density: None, rng }
    }

    /// Creates a ray that continues from the hit; its direction counts as not sampled unless the caller sets a density.
    pub(super) fn on(&self, ray: Ray, kind: RayKind, weight: DVec3) -> Self {
        Self { ray, kind, weight, depth: self.depth + 1, density: None, ..*self }
    }
}

#[derive(Clone, Debug, Default)]
pub(super) struct Scatter {
    /// Weighted light that needs no further ray.
    pub(super) light: DVec3,
    /// Shadow rays, each with the light that it adds if nothing is hit before t = 1.
    pub(super) shadows: Vec<(Ray, DVec3)>,
    pub(super) next: Vec<PathRay>,
}

impl Scatter {
    pub(super) fn of(light: DVec3) -> Self {
        Self { light, ..Self::default() }
    }
}

pub(super) trait Shade: Sync {
    fn shade(&self, flight: &PathRay, surfel: &Surfel<'_>) -> Scatter;
}

/// Light of a chunk by slot, and the hits of its eye rays.
pub(super) struct Wave {
    pub(super) light: Vec<DVec3>,
    pub(super) first: Vec<Option<Hit>>,
}

/// Traces eye rays, one per slot, and all rays that the shader spawns, with sums in an order free of the chunk's size.
pub(super) fn follow(
    tracer: &mut CountingCaster<'_>,
    mut flights: Vec<PathRay>,
    scene: &Scene,
    settings: &Settings,
    shader: &impl Shade,
) -> Result<Wave, InputError> {
    let shade = |flight: &PathRay, hit: Option<Hit>| {
        match hit.and_then(|hit| Surfel::new(scene, settings.rounding, &flight.ray, hit)) {
            Some(surfel) => shader.shade(flight, &surfel),
            // Light sampling never samples the background, so it needs no MIS weight.
            None => Scatter::of(flight.weight * wide(settings.background)),
        }
    };
    let mut wave = Wave { light: vec![DVec3::ZERO; flights.len()], first: Vec::new() };
    let mut shadows: Vec<(u32, Ray, DVec3)> = Vec::new();
    let mut first = true;
    while !(flights.is_empty() && shadows.is_empty()) {
        let hits = cast(tracer, &flights, &shadows)?;
        let (ahead, between) = hits.split_at(flights.len().min(hits.len()));
        for ((slot, _, light), hit) in shadows.drain(..).zip(between) {
            if !is_occluder(*hit) {
                wave.add(slot, light);
            }
        }
        let scattered: Vec<Scatter> = flights.par_iter().zip(ahead).map(|(flight, hit)| shade(flight, *hit)).collect();
        if std::mem::take(&mut first) {
            wave.first = ahead.to_vec();
        }
        let mut next = Vec::with_capacity(flights.len());
        for (flight, scatter) in flights.iter().zip(scattered) {
            wave.add(flight.slot, scatter.light);
            shadows.extend(scatter.shadows.into_iter().map(|(ray, light)| (flight.slot, ray, light)));
            next.extend(scatter.next);
        }
        flights = next;
    }
    Ok(wave)
}

impl Wave {
    fn add(&mut self, slot: u32, light: DVec3) {
        self.light[slot as usize] += light;
    }
}

fn cast(
    tracer: &mut CountingCaster<'_>,
    flights: &[PathRay],
    shadows: &[(u32, Ray, DVec3)],
) -> Result<Vec<Option<Hit>>, CastError> {
    let rays: Vec<Ray> = flights.iter().map(|f| f.ray).chain(shadows.iter().map(|s| s.1)).collect();
    tracer.cast(&rays, |index| flights.get(index).map_or(RayKind::Shadow, |flight| flight.kind))
}
