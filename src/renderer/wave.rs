//! Breadth first: all rays of a bundle, then all that they give rise to, until none is left.

use glam::DVec3;
use rayon::prelude::*;

use super::RenderError;
use super::counting::{CountingCaster, RayKind};
use crate::geom::random::CounterRng;
use crate::geom::{Hit, Ray};
use crate::tracer::{CastError, is_occluder};

/// Random numbers of one sample of one pixel, along one branch of its tree of rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dice {
    stream: CounterRng,
    pixel: u64,
    sample: u64,
    branch: u64,
}

/// Numbers that a sample needs before its first hit: place in the pixel and on the lens.
const BEFORE: u64 = 8;
/// Numbers that one hit may need.
const A_HIT: u64 = 16;

impl Dice {
    pub(super) const fn new(seed: u64, pixel: u64, sample: u64) -> Self {
        Self { stream: CounterRng::new(seed), pixel, sample, branch: 0 }
    }

    /// The dice of one of several rays that leave a hit.
    pub(super) const fn branch(self, branch: u64) -> Self {
        Self { branch, ..self }
    }

    /// The n-th number before the first hit.
    pub(super) fn before(self, n: u64) -> f64 {
        self.stream.unit(self.pixel, self.sample, n)
    }

    /// The n-th number, below 16, at a hit after so many others.
    pub(super) fn at(self, depth: u32, n: u64) -> f64 {
        self.stream.unit(self.pixel, self.sample, (self.branch << 24) + BEFORE + A_HIT * u64::from(depth) + n)
    }

    pub(super) fn pair(self, depth: u32, n: u64) -> [f64; 2] {
        [self.at(depth, n), self.at(depth, n + 1)]
    }
}

/// A ray on its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathRay {
    /// The ray.
    pub(super) ray: Ray,
    /// What it is for.
    pub(super) kind: RayKind,
    /// Whose radiance it adds to: the place in the chunk.
    pub(super) slot: u32,
    /// What light along it counts.
    pub(super) weight: DVec3,
    /// Hits before this one.
    pub(super) depth: u32,
    /// Density of the choice of its direction over solid angle, if there was a choice.
    pub(super) density: Option<f64>,
    /// Its random numbers.
    pub(super) dice: Dice,
}

impl PathRay {
    /// The ray of a sample from the eye.
    pub(super) fn eye(ray: Ray, slot: u32, dice: Dice) -> Self {
        Self { ray, kind: RayKind::Eye, slot, weight: DVec3::ONE, depth: 0, density: None, dice }
    }

    /// The ray that goes on from its hit; without choice of direction unless the caller says otherwise.
    pub(super) fn on(&self, ray: Ray, kind: RayKind, weight: DVec3) -> Self {
        Self { ray, kind, weight, depth: self.depth + 1, density: None, ..*self }
    }
}

/// What a hit gives rise to.
#[derive(Clone, Debug, Default)]
pub(super) struct Scatter {
    /// Light that goes to the eye at once, weighted.
    pub(super) light: DVec3,
    /// Rays to lights, with what arrives if nothing is before t = 1.
    pub(super) shadows: Vec<(Ray, DVec3)>,
    /// Rays that go on.
    pub(super) next: Vec<PathRay>,
}

impl Scatter {
    pub(super) fn of(light: DVec3) -> Self {
        Self { light, ..Self::default() }
    }
}

/// What a renderer is: a hit (or none), and what comes of it.
pub(super) trait Shade: Sync {
    fn shade(&self, flight: &PathRay, hit: Option<Hit>) -> Scatter;
}

/// A chunk's light, by slot, and the hits of its first rays.
pub(super) struct Wave {
    pub(super) light: Vec<DVec3>,
    pub(super) first: Vec<Option<Hit>>,
}

/// Follows rays from the eye, one a slot, to their ends. Every sum runs in an order that the chunk's size does not
/// change.
pub(super) fn follow(
    tracer: &mut CountingCaster<'_>,
    mut flights: Vec<PathRay>,
    shader: &impl Shade,
) -> Result<Wave, RenderError> {
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
        let scattered: Vec<Scatter> =
            flights.par_iter().zip(ahead).map(|(flight, hit)| shader.shade(flight, *hit)).collect();
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
        let sum = &mut self.light[slot as usize];
        *sum = *sum + light;
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
