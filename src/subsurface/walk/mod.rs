//! Photons followed one by one through a homogeneous medium with a smooth boundary, for the dipole's own error.
//!
//! A photon enters refracted, goes exponentially distributed steps of mean 1 / sigma'_t, is absorbed or scattered
//! isotropically at the end of each, and meets the boundary from inside, which reflects it by Fresnel's formula or
//! lets it leave. Nothing is weighted: each photon leaves, is absorbed, or is given up at the step limit, so the
//! counts balance exactly. Random numbers are a function of photon and event, and counts are integers, so the result
//! has the same bits on any number of threads.
//!
//! - [`half_space`], [`sphere`]: bodies in closed form, exitance by distance;
//! - [`mesh`]: closed meshes through a [`Caster`](crate::tracer::Caster), exitance by face.

mod body;
mod boundary;
mod mesh;
mod tally;

pub use body::{half_space, sphere};
pub use boundary::Entry;
pub use mesh::{MeshWalkError, mesh};
pub use tally::{BATCHES, Estimate, Tally};

use super::material::{Coefficients, MaterialError, check_eta};
use boundary::PhotonRng;

/// A medium and how many photons to send into it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walk {
    /// Scattering and absorption per mm.
    pub coefficients: Coefficients,
    /// The index of refraction.
    pub eta: f64,
    /// How photons enter.
    pub entry: Entry,
    /// Photons that enter, at least [`BATCHES`].
    pub photons: u64,
    /// Steps after which a photon is given up: without absorption some walk on almost forever.
    pub max_steps: u32,
    /// Random seed.
    pub seed: u64,
}

impl Walk {
    /// A million diffuse photons of at most a million steps.
    ///
    /// # Errors
    /// [`MaterialError`] for figures that make no medium.
    pub fn new(coefficients: Coefficients, eta: f64) -> Result<Self, MaterialError> {
        coefficients.check()?;
        check_eta(eta)?;
        Ok(Self { coefficients, eta, entry: Entry::Diffuse, photons: 1_000_000, max_steps: 1_000_000, seed: 1 })
    }

    /// The photons of a batch.
    fn batch(&self, batch: usize) -> std::ops::Range<u64> {
        let end = |batch: usize| (u128::from(self.photons) * batch as u128 / BATCHES as u128) as u64;
        end(batch)..end(batch + 1)
    }

    fn rng(&self, photon: u64) -> PhotonRng {
        PhotonRng::new(self.seed, photon)
    }
}
