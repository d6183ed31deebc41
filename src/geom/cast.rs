//! First hits, asked for in bundles: what renderers and form factors need of whoever traces.

use thiserror::Error;

use super::Ray;

/// What a ray hits first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The triangle, by its place in the mesh.
    pub triangle: u32,
    /// The ray parameter, in multiples of the ray's direction.
    pub t: f32,
}

/// Whoever traced could not.
#[derive(Debug, Error)]
#[error("the rays could not be traced")]
pub struct CastError(#[source] pub Box<dyn std::error::Error + Send + Sync>);

/// Finds first hits, a bundle of rays at a time: the interface of a ray engine to its host application (Ray Engine, section 5.2).
pub trait Caster {
    /// The first hit of each ray, in the order of the rays. Bundles may be of any size; large ones leave room to sort them.
    ///
    /// # Errors
    /// [`CastError`] if whoever traces cannot.
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError>;
}
