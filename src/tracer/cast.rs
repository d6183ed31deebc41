//! The interface between a ray caster and the host application (Ray Engine, section 5.2).

use thiserror::Error;

use crate::geom::{Hit, Ray};

/// The ray caster failed.
#[derive(Debug, Error)]
#[error("the rays could not be traced")]
pub struct CastError(#[source] pub Box<dyn std::error::Error + Send + Sync>);

/// Finds hits for bundles of rays of any size. Large bundles leave a caster room to sort them.
pub trait Caster {
    /// The first hit of each ray, in the order of the rays.
    ///
    /// # Errors
    /// [`CastError`] if the caster fails.
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError>;

    /// Whether anything is hit before t = 1, per ray: shadow rays, whose directions end at the light. Any hit will do,
    /// which casters that can stop at the first one found answer faster than [`Self::cast`].
    ///
    /// # Errors
    /// [`CastError`] if the caster fails.
    fn occluded(&mut self, rays: &[Ray]) -> Result<Vec<bool>, CastError> {
        Ok(self.cast(rays)?.into_iter().map(is_occluder).collect())
    }
}

/// Whether a first hit lies before t = 1.
#[must_use]
pub fn is_occluder(hit: Option<Hit>) -> bool {
    hit.is_some_and(|hit| hit.t < 1.0)
}
