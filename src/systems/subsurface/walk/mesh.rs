//! Walks in closed meshes, all photons of a batch a step at a time, so that a caster gets many rays at once.

use glam::DVec3;

use super::boundary::{PhotonRng, reflected};
use super::settings::PhotonWalk;
use super::tally::{BATCHES, BatchCounts, WalkTally};
use crate::error::{InputError, input_error};
use crate::geom::vector::{narrow, unit, wide};
use crate::geom::{Hit, Mesh, Ray};
use crate::tracer::Caster;

/// Points nearer to the boundary than this fraction of the mesh's diagonal count as on it, and reflected rays start as
/// far inside: rounding to single precision is about a tenth of it.
const CLEARANCE: f64 = 1e-6;

/// Follows photons that enter a closed mesh whose faces run counter-clockwise from outside. `flux` is what enters each
/// face, relative to the others: its area for light from everywhere. Bins are the faces. The caster must see the
/// insides of faces.
///
/// # Errors
/// [`InputError`]: scale or fluxes make no sense, or the caster fails.
pub fn mesh(
    walk: &PhotonWalk,
    mesh: &Mesh,
    mm_per_unit: f64,
    flux: &[f64],
    caster: &mut dyn Caster,
) -> Result<WalkTally, InputError> {
    if !(mm_per_unit > 0.0 && mm_per_unit.is_finite()) {
        return Err(input_error!("subsurface::walk" =>
            "expected a positive number of mm per unit, found {mm_per_unit}"));
    }
    let sources = Sources::new(mesh, flux).ok_or_else(|| {
        input_error!("subsurface::walk" =>
            "expected the flux that enters each of the {} faces, finite, not negative, and above 0 for one of them",
            mesh.len())
    })?;
    let bounds = mesh.bounds().unwrap_or_default();
    let clearance = CLEARANCE * (wide(bounds[1]) - wide(bounds[0])).length();
    let sigma_t = walk.coefficients.sigma_t_prime();
    let mut waves = Waves { walk, mesh, clearance, sigma_t: sigma_t * mm_per_unit, caster };
    let batches: Result<Vec<_>, _> = (0..BATCHES).map(|batch| waves.batch(batch, &sources)).collect();
    let scale = mm_per_unit * mm_per_unit;
    let areas = (0..mesh.len() as u32).map(|face| mesh.area(face) * scale).collect();
    Ok(WalkTally::new(areas, batches?, 1.0 / sigma_t))
}

/// Where photons enter.
struct Sources {
    /// Sums of fluxes up to and with each face.
    sums: Vec<f64>,
}

impl Sources {
    fn new(mesh: &Mesh, flux: &[f64]) -> Option<Self> {
        let good = |face: usize, flux: f64| flux >= 0.0 && (flux == 0.0 || mesh.area(face as u32) > 0.0);
        let mut sum = 0.0;
        let all = flux.iter().enumerate().map(|(face, &flux)| {
            sum += flux;
            good(face, flux).then_some(sum)
        });
        let sums: Vec<f64> = all.collect::<Option<_>>()?;
        (flux.len() == mesh.len() && sum > 0.0 && sum.is_finite()).then_some(Self { sums })
    }

    fn face(&self, chance: f64) -> u32 {
        let sought = chance * self.sums.last().copied().unwrap_or(0.0);
        self.sums.partition_point(|&sum| sum <= sought).min(self.sums.len() - 1) as u32
    }
}

/// A photon between two events.
struct Photon {
    rng: PhotonRng,
    at: DVec3,
    direction: DVec3,
}

struct Waves<'a> {
    walk: &'a PhotonWalk,
    mesh: &'a Mesh,
    clearance: f64,
    /// Per unit of the mesh.
    sigma_t: f64,
    caster: &'a mut dyn Caster,
}

impl Waves<'_> {
    fn batch(&mut self, batch: usize, sources: &Sources) -> Result<BatchCounts, InputError> {
        let mut counts = BatchCounts::new(self.mesh.len());
        let mut photons: Vec<Photon> = Vec::new();
        for photon in self.walk.batch(batch) {
            counts.entered += 1;
            match self.enter(photon, sources) {
                Some(photon) => photons.push(photon),
                None => counts.lost += 1,
            }
        }
        for _ in 0..self.walk.max_steps {
            if photons.is_empty() {
                break;
            }
            // A direction that is not finite cannot occur: all are unit vectors.
            let rays: Option<Vec<Ray>> =
                photons.iter().map(|photon| Ray::new(narrow(photon.at), narrow(photon.direction)).ok()).collect();
            let Some(rays) = rays else { break };
            let hits = self.caster.cast(&rays).map_err(|error| InputError::of("subsurface::walk", error))?;
            let mut hits = hits.into_iter();
            photons.retain_mut(|photon| self.advance(photon, hits.next().flatten(), &mut counts));
        }
        counts.cut += photons.len() as u64;
        Ok(counts)
    }

    /// The unit normal of a face that points outwards.
    fn normal(&self, face: u32) -> Option<DVec3> {
        let [a, b, c] = self.mesh.corners(face)?.map(wide);
        unit((b - a).cross(c - a))
    }

    fn enter(&self, photon: u64, sources: &Sources) -> Option<Photon> {
        let mut rng = self.walk.rng(photon);
        let face = sources.face(rng.pair()[0]);
        let [a, b, c] = self.mesh.corners(face)?.map(wide);
        let inwards = -self.normal(face)?;
        let weights = rng.barycentric();
        let at = weights.x * a + weights.y * b + weights.z * c + self.clearance * inwards;
        let direction = rng.enter(self.walk.entry, self.walk.eta, inwards);
        Some(Photon { rng, at, direction })
    }

    /// Moves a photon to its next event; whether it goes on.
    fn advance(&self, photon: &mut Photon, hit: Option<Hit>, counts: &mut BatchCounts) -> bool {
        let [step, chance] = photon.rng.step();
        let Some((hit, normal)) = hit.and_then(|hit| Some((hit, self.normal(hit.triangle)?))) else {
            counts.lost += 1;
            return false;
        };
        let length = f64::from(hit.t).max(0.0);
        let inside = length - self.clearance;
        if step < inside * self.sigma_t {
            counts.path += step;
            photon.at += step / self.sigma_t * photon.direction;
            if chance >= self.walk.coefficients.alpha_prime() {
                counts.absorbed += 1;
                return false;
            }
            photon.direction = photon.rng.direction();
            return true;
        }
        counts.path += length * self.sigma_t;
        let outwards = if normal.dot(photon.direction) < 0.0 { -normal } else { normal };
        if photon.rng.leaves(self.walk.eta, photon.direction.dot(outwards)) {
            counts.left[hit.triangle as usize] += 1;
            return false;
        }
        photon.at += length * photon.direction - self.clearance * outwards;
        photon.direction = reflected(photon.direction, outwards);
        true
    }
}
