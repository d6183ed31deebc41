//! The interface between a ray caster and the host application (Ray Engine, section 5.2).

use thiserror::Error;

use crate::error::InputError;
use crate::geom::{Hit, Ray};

/// The ray caster failed.
#[derive(Debug, Error)]
#[error("the rays could not be traced")]
pub struct CastError(#[source] pub Box<dyn std::error::Error + Send + Sync>);

impl From<CastError> for InputError {
    fn from(error: CastError) -> Self {
        Self::of("", error)
    }
}

/// Ray caster: finds hits for bundles of rays of any size. Large bundles allow an implementation to sort rays.
pub trait Caster {
    /// Returns the first hit of each ray, in the order of the rays. Fails with [`CastError`] if the caster fails.
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError>;

    /// Returns for each ray whether it hits anything before t = 1: for shadow rays, whose direction vector ends at the
    /// light. Faster than [`Self::cast`] in casters that can stop at any hit.
    fn occluded(&mut self, rays: &[Ray]) -> Result<Vec<bool>, CastError> {
        Ok(self.cast(rays)?.into_iter().map(is_occluder).collect())
    }
}

/// Returns `true` if a first hit lies before t = 1.
pub fn is_occluder(hit: Option<Hit>) -> bool {
    hit.is_some_and(|hit| hit.t < 1.0)
}
