//! Directions and random numbers of a photon: entry, scattering, reflection.

use std::f64::consts::TAU;

use crossbar::elementary::{ln, sin_cos};
use crossbar::geom::random::CounterRng;
use crossbar::subsurface::fresnel_transmittance;
use glam::DVec3;

/// Maximum number of tries for a direction that passes the boundary.
const MAX_TRIES: u32 = 1000;

/// Boundary model for entering photons. All counts are per photon that has passed the boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PhotonEntry {
    /// Equal radiance from all directions outside, refracted.
    Diffuse,
    /// A beam from outside at this cosine of the angle of incidence, refracted, with a random azimuth around the
    /// normal.
    Beam(f64),
}

/// The random numbers of one photon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PhotonRng {
    stream: CounterRng,
    photon: u64,
    event: u64,
}

impl PhotonRng {
    pub(crate) fn new(seed: u64, photon: u64) -> Self {
        Self { stream: CounterRng::new(seed), photon, event: 0 }
    }

    /// Two numbers in (0, 1), odd multiples of 2^-33.
    fn pair(&mut self) -> [f64; 2] {
        let bits = self.stream.bits(self.photon, self.event, 0);
        self.event += 1;
        [bits >> 32, bits & 0xffff_ffff].map(|half| (half as f64 + 0.5) / 4_294_967_296.0)
    }

    /// A direction uniformly distributed over the sphere.
    pub(crate) fn direction(&mut self) -> DVec3 {
        let [u, v] = self.pair();
        around(DVec3::Z, 1.0 - 2.0 * u, v)
    }

    /// Length of a step in mean free paths, and a number in (0, 1) for the event at its end.
    pub(crate) fn step(&mut self) -> [f64; 2] {
        let [u, v] = self.pair();
        [-ln(u), v]
    }

    /// The direction of a photon that enters, for the unit normal that points inwards.
    pub(crate) fn enter(&mut self, entry: PhotonEntry, eta: f64, inwards: DVec3) -> DVec3 {
        let outside: Option<f64> = match entry {
            PhotonEntry::Beam(cosine) => Some(cosine),
            // At least a third of the tries succeeds; the limit is needed for indices of refraction that are NaN.
            PhotonEntry::Diffuse => (0..MAX_TRIES).find_map(|_| {
                let [u, v] = self.pair();
                let cosine = u.sqrt();
                (v < fresnel_transmittance(eta, cosine)).then_some(cosine)
            }),
        };
        let outside = outside.unwrap_or(1.0);
        let sine = (1.0 - outside * outside).max(0.0).sqrt() / eta;
        let [turn, _] = self.pair();
        around(inwards, (1.0 - sine * sine).sqrt(), turn)
    }

    /// Returns `true` if a photon leaves at the boundary, which it meets from inside at this cosine.
    pub(crate) fn leaves(&mut self, eta: f64, cosine: f64) -> bool {
        self.pair()[0] < fresnel_transmittance(1.0 / eta, cosine)
    }
}

/// The unit vector at this cosine to a unit axis, with azimuth `turn`, as a fraction of a full turn.
fn around(axis: DVec3, cosine: f64, turn: f64) -> DVec3 {
    let (sin, cos) = sin_cos(TAU * turn);
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (x, y) = axis.any_orthonormal_pair();
    sine * (cos * x + sin * y) + cosine * axis
}

/// A direction after reflection by a plane with this unit normal.
pub(crate) fn reflected(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - 2.0 * direction.dot(normal) * normal
}
