//! Radiance transfer at the vertices of a mesh, as matrices of harmonics.
//!
//! - [`TracedRays`]: the blocked directions of each vertex, and the triangles that block them;
//! - [`Response`]: the exit radiance of a material per light from each direction;
//! - [`Transfer`]: the matrix of each vertex, with bounces and [subsurface scattering](Transfer::scattered).

mod gather;
mod rays;
mod response;
mod scattering;
mod whole;

pub use rays::{TracedRays, TransferCounts, ray_origins};
pub use response::{Incident, Response};
pub use scattering::ScatteringOptions;
pub use whole::Transfer;
