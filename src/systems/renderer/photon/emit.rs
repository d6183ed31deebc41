//! Emission and tracing of photons.

use glam::DVec3;
use rayon::prelude::*;

use crate::error::InputError;
use crate::geom::Hit;
use crate::renderer::Settings;
use crate::renderer::counting::{CountingCaster, RayKind};
use crate::renderer::lights::Lights;
use crate::renderer::lobes::{Lobes, choose_specular};
use crate::renderer::photon_map::Photon;
use crate::renderer::surfel::Surfel;
use crate::renderer::wave::{PathRay, SampleRng};
use crate::scene::Scene;

/// Offset of photon numbers in the random number sequence, so that photons share no numbers with pixels.
const FIRST: u64 = 1 << 40;
/// Offset of caustic photons, so that they share no random numbers with the global map.
const CAUSTIC: u64 = 1 << 41;

pub(super) struct PhotonEmission<'a> {
    pub(super) scene: &'a Scene,
    pub(super) settings: &'a Settings,
    pub(super) lights: &'a Lights<'a>,
    pub(super) count: u32,
    /// `true` to store only light that has passed at least one mirror or glass, and no other surface.
    pub(super) caustic: bool,
}

/// Interaction of a photon at a hit.
#[derive(Default)]
struct PhotonHit {
    stored: Option<Photon>,
    next: Option<PathRay>,
}

impl PhotonEmission<'_> {
    /// Emits photons, and returns the stored ones, ordered by photon and then by hit.
    pub(super) fn landed(&self, tracer: &mut CountingCaster<'_>) -> Result<Vec<Photon>, InputError> {
        tracer.begin(if self.caustic { "caustic photons" } else { "photons" }, u64::from(self.count));
        let chunk = self.settings.bundle.clamp(1, 1 << 24) as u32;
        let mut landed = Vec::new();
        let mut start = 0;
        while start < self.count {
            let end = self.count.min(start.saturating_add(chunk));
            let flights = (start..end).into_par_iter().filter_map(|photon| self.leaving(photon, start)).collect();
            let mut part = self.follow(tracer, flights)?;
            // Waves order by depth; sorting by photon makes the map independent of the chunk size.
            part.sort_by_key(|(number, _)| *number);
            landed.extend(part.into_iter().map(|(_, photon)| photon));
            tracer.advance(u64::from(end - start));
            start = end;
        }
        Ok(landed)
    }

    fn leaving(&self, photon: u32, start: u32) -> Option<PathRay> {
        let first = FIRST + if self.caustic { CAUSTIC } else { 0 };
        let rng = SampleRng::new(self.settings.seed, first + u64::from(photon), 0);
        let leaving = self.lights.leaving(|n| rng.before(n))?;
        let weight = 1.0 / f64::from(self.count) * leaving.power;
        Some(PathRay { kind: RayKind::Photon, weight, ..PathRay::eye(leaving.ray, photon - start, rng) })
    }

    fn follow(
        &self,
        tracer: &mut CountingCaster<'_>,
        mut flights: Vec<PathRay>,
    ) -> Result<Vec<(u32, Photon)>, InputError> {
        let mut landed = Vec::new();
        while !flights.is_empty() {
            let rays: Vec<_> = flights.iter().map(|flight| flight.ray).collect();
            let hits = tracer.cast(&rays, |_| RayKind::Photon)?;
            let hits: Vec<PhotonHit> =
                flights.par_iter().zip(&hits).map(|(flight, hit)| self.interact(flight, *hit)).collect();
            let numbers = flights.iter().map(|flight| flight.slot);
            landed.extend(numbers.zip(&hits).filter_map(|(slot, landing)| Some((slot, landing.stored?))));
            flights = hits.into_iter().filter_map(|landing| landing.next).collect();
        }
        Ok(landed)
    }

    fn interact(&self, flight: &PathRay, hit: Option<Hit>) -> PhotonHit {
        let Some(surfel) = hit.and_then(|hit| Surfel::new(self.scene, self.settings.rounding, &flight.ray, hit)) else {
            return PhotonHit::default();
        };
        let more = flight.depth + 1 < self.settings.depth;
        let rng = flight.rng;
        let Some(lobes) = Lobes::of(&surfel.material.surface) else {
            let specular = choose_specular(&surfel, rng.at(flight.depth, 3)).filter(|_| more);
            let next = specular.and_then(|specular| {
                let next = continue_photon(flight, &surfel, specular.towards, specular.weight)?;
                // The factor is applied after Russian roulette, because it is undone where the light leaves the glass.
                Some(PathRay { weight: specular.flux_scale * next.weight, ..next })
            });
            return PhotonHit { stored: None, next };
        };
        let stored = (self.settings.depth > 0 && (!self.caustic || flight.depth > 0)).then_some(Photon {
            at: surfel.place.at,
            normal: surfel.normal,
            from: surfel.view,
            power: flight.weight,
        });
        if self.caustic || !more {
            return PhotonHit { stored, next: None };
        }
        let chosen = lobes.choose(&surfel, rng.at(flight.depth, 3), rng.pair(flight.depth, 4));
        let next = chosen.and_then(|chosen| {
            let turned = adjoint(&surfel, chosen.towards);
            continue_photon(flight, &surfel, chosen.towards, turned * chosen.weight)
        });
        PhotonHit { stored, next }
    }
}

/// Correction factor of light relative to importance at a shading normal (Veach 1997, equation 5.19).
fn adjoint(surfel: &Surfel<'_>, towards: DVec3) -> f64 {
    let smooth = surfel.view.dot(surfel.shading) * towards.dot(surfel.normal);
    let flat = surfel.view.dot(surfel.normal) * towards.dot(surfel.shading);
    if flat > 0.0 { smooth / flat } else { 0.0 }
}

/// Continues with a probability equal to the weight, so that the power of photons stays approximately constant.
fn continue_photon(flight: &PathRay, surfel: &Surfel<'_>, towards: DVec3, weight: DVec3) -> Option<PathRay> {
    let chance = weight.max_element().min(1.0);
    if chance <= 0.0 || flight.rng.at(flight.depth, 6) >= chance {
        return None;
    }
    let power = flight.weight * (1.0 / chance * weight);
    Some(flight.on(surfel.ray(towards)?, RayKind::Photon, power))
}
