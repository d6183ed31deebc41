//! Photon walks in bodies whose boundary has a formula.

use glam::DVec3;
use rayon::prelude::*;

use super::PhotonWalk;
use super::photon::{PhotonRng, reflected};
use super::tally::{BATCHES, BatchCounts, WalkTally};

/// A body, measured in mean free paths; photons enter at the origin along +z.
trait Body: Copy + Sync {
    /// Distance at which a ray from inside leaves, and the outward unit normal there.
    fn boundary(self, from: DVec3, direction: DVec3) -> (f64, DVec3);

    /// Moves a point back that rounding has put on the wrong side of the boundary.
    fn kept(self, at: DVec3) -> DVec3;
}

#[derive(Clone, Copy)]
struct HalfSpace;

impl Body for HalfSpace {
    fn boundary(self, from: DVec3, direction: DVec3) -> (f64, DVec3) {
        let length = if direction.z < 0.0 { from.z / -direction.z } else { f64::INFINITY };
        (length, DVec3::NEG_Z)
    }

    fn kept(self, at: DVec3) -> DVec3 {
        at.with_z(at.z.max(0.0))
    }
}

/// A sphere around (0, 0, radius).
#[derive(Clone, Copy)]
struct Sphere {
    radius: f64,
}

impl Body for Sphere {
    fn boundary(self, from: DVec3, direction: DVec3) -> (f64, DVec3) {
        let from = from.with_z(from.z - self.radius);
        let along = from.dot(direction);
        let inside = (self.radius * self.radius - from.length_squared()).max(0.0);
        let root = (along * along + inside).sqrt();
        // -along + root, without subtracting nearly equal values.
        let length = if along > 0.0 { inside / (along + root) } else { root - along };
        (length, (from + length * direction) / self.radius)
    }

    fn kept(self, at: DVec3) -> DVec3 {
        let from = at.with_z(at.z - self.radius);
        let length = from.length();
        if length > self.radius { at + (self.radius / length - 1.0) * from } else { at }
    }
}

/// Follows photons that enter a half space at a point. Bins are the rings between ascending `radii` in mm; the first is
/// a disc.
pub(crate) fn half_space(walk: &PhotonWalk, radii: &[f64]) -> WalkTally {
    follow(walk, HalfSpace, radii)
}

/// Follows photons that enter a sphere of this radius (mm) at a point. Bins are the rings between ascending chords in
/// mm from that point.
pub(crate) fn sphere(walk: &PhotonWalk, radius: f64, chords: &[f64]) -> WalkTally {
    follow(walk, Sphere { radius: radius * walk.coefficients.sigma_t_prime() }, chords)
}

fn follow(walk: &PhotonWalk, body: impl Body, radii: &[f64]) -> WalkTally {
    let sigma_t = walk.coefficients.sigma_t_prime();
    let squares: Vec<f64> = radii.iter().map(|radius| (radius * sigma_t) * (radius * sigma_t)).collect();
    let batches = (0..BATCHES).into_par_iter().map(|batch| {
        let mut counts = BatchCounts::new(radii.len());
        for photon in walk.batch(batch) {
            counts.entered += 1;
            let mut rng = walk.rng(photon);
            match one(walk, body, &mut rng, &mut counts.path) {
                Fate::Left(at) => {
                    let square = at.length_squared();
                    counts.left[squares.partition_point(|&bound| bound < square)] += 1;
                }
                Fate::Absorbed => counts.absorbed += 1,
                Fate::Cut => counts.cut += 1,
            }
        }
        counts
    });
    WalkTally::new(batches.collect(), 1.0 / sigma_t)
}

enum Fate {
    Left(DVec3),
    Absorbed,
    Cut,
}

fn one(walk: &PhotonWalk, body: impl Body, rng: &mut PhotonRng, path: &mut f64) -> Fate {
    let alpha = walk.coefficients.alpha_prime();
    let mut at = DVec3::ZERO;
    let mut direction = rng.enter(walk.entry, walk.eta, DVec3::Z);
    for _ in 0..walk.max_steps {
        let [step, chance] = rng.step();
        let (length, outwards) = body.boundary(at, direction);
        if step < length {
            *path += step;
            at = body.kept(at + step * direction);
            if chance >= alpha {
                return Fate::Absorbed;
            }
            direction = rng.direction();
        } else {
            *path += length;
            at = body.kept(at + length * direction);
            if rng.leaves(walk.eta, direction.dot(outwards)) {
                return Fate::Left(at);
            }
            direction = reflected(direction, outwards);
        }
    }
    Fate::Cut
}
