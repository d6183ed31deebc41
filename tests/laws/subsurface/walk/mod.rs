//! Photons traced one by one through a homogeneous medium with a smooth boundary, to measure the dipole's error.
//!
//! A photon enters refracted, goes exponentially distributed steps of mean 1 / sigma'_t, is absorbed or scattered
//! isotropically at the end of each, and meets the boundary from inside, which reflects it by Fresnel's formula or
//! lets it leave. Photons have no weights: each one leaves, is absorbed, or is given up at the step limit, so the
//! counts balance exactly. Random numbers are a function of photon and event.

mod body;
mod photon;
mod tally;

use std::ops::Range;

use crossbar::subsurface::Coefficients;
use photon::PhotonRng;
use tally::BATCHES;

pub(crate) use body::{half_space, sphere};
pub(crate) use photon::PhotonEntry;
pub(crate) use tally::WalkTally;

/// A medium, and the number of photons to trace in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PhotonWalk {
    /// Scattering and absorption per mm.
    pub(crate) coefficients: Coefficients,
    /// The index of refraction.
    pub(crate) eta: f64,
    /// Boundary model for entering photons.
    pub(crate) entry: PhotonEntry,
    /// Number of photons that enter, at least [`BATCHES`].
    pub(crate) photons: u64,
    /// Number of steps after which a photon is given up: without absorption some walks are almost endless.
    pub(crate) max_steps: u32,
    /// Random seed.
    pub(crate) seed: u64,
}

impl PhotonWalk {
    /// Indices of the photons of a batch.
    fn batch(&self, batch: usize) -> Range<u64> {
        let end = |batch: usize| (u128::from(self.photons) * batch as u128 / BATCHES as u128) as u64;
        end(batch)..end(batch + 1)
    }

    /// The random numbers of a photon.
    fn rng(&self, photon: u64) -> PhotonRng {
        PhotonRng::new(self.seed, photon)
    }
}
