//! The medium that is walked through, and the number of photons.

use std::ops::Range;

use super::boundary::{PhotonEntry, PhotonRng};
use super::tally::BATCHES;
use crate::error::InputError;
use crate::subsurface::material::{Coefficients, check_eta};

/// A medium and how many photons to send into it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhotonWalk {
    /// Scattering and absorption per mm.
    pub coefficients: Coefficients,
    /// The index of refraction.
    pub eta: f64,
    /// How photons enter.
    pub entry: PhotonEntry,
    /// Photons that enter, at least [`BATCHES`].
    pub photons: u64,
    /// Steps after which a photon is given up: without absorption some walk on almost forever.
    pub max_steps: u32,
    /// Random seed.
    pub seed: u64,
}

impl PhotonWalk {
    /// A million diffuse photons of at most a million steps.
    ///
    /// # Errors
    /// [`InputError`] for figures that make no medium.
    pub fn new(coefficients: Coefficients, eta: f64) -> Result<Self, InputError> {
        coefficients.check()?;
        check_eta(eta)?;
        Ok(Self { coefficients, eta, entry: PhotonEntry::Diffuse, photons: 1_000_000, max_steps: 1_000_000, seed: 1 })
    }

    /// The photons of a batch.
    pub(super) fn batch(&self, batch: usize) -> Range<u64> {
        let end = |batch: usize| (u128::from(self.photons) * batch as u128 / BATCHES as u128) as u64;
        end(batch)..end(batch + 1)
    }

    /// The random numbers of a photon.
    pub(super) fn rng(&self, photon: u64) -> PhotonRng {
        PhotonRng::new(self.seed, photon)
    }
}
