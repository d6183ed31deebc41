//! Radiance transfer at the vertices of a mesh.
//!
//! - [`Vertices`]: unique positions, normals and tangents, with a [`LocalFrame`] each;
//! - [`TracedRays`]: which directions are blocked, and by what;
//! - [`Response`]: how a material answers light from each direction;
//! - [`Transfer`]: the matrix of each vertex, with bounces and [light that scatters below](Transfer::scattered).

mod error;
mod frame;
mod gather;
mod origins;
#[expect(clippy::needless_range_loop, reason = "arrays in step, lane by lane, become vector instructions")]
mod packets;
mod rays;
mod response;
mod scattering;
#[expect(clippy::needless_range_loop, reason = "arrays in step, lane by lane, become vector instructions")]
mod shadow_leaf;
mod shadow_tree;
mod shooter;
mod skyline;
mod vertices;
mod whole;

pub use error::TransferError;
pub use frame::LocalFrame;
pub(crate) use origins::{RayOrigin, origins};
pub use rays::{TracedRays, TransferCounts};
pub use response::{Incident, Response};
pub use scattering::ScatteringOptions;
pub(crate) use shooter::ray_length;
pub(crate) use skyline::{Occluders, SkyPart};
pub use vertices::{Tangents, Vertices};
pub use whole::{Bounces, Transfer};
