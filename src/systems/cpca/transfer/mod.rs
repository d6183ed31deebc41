//! Radiance transfer at the vertices of a mesh, as matrices of harmonics.
//!
//! - [`TracedRays`]: the directions that are blocked, and by what;
//! - [`Response`]: how a material answers light from each direction;
//! - [`Transfer`]: the matrix of each vertex, with bounces and [light that scatters below](Transfer::scattered).

mod gather;
mod rays;
mod response;
mod scattering;
mod whole;

pub use rays::{RayAnswers, TracedRays, TransferCounts};
pub use response::{Incident, Response};
pub use scattering::ScatteringOptions;
pub use whole::{Bounces, Transfer};
