//! Rays on the host: the octree, first hits and any hits in single precision, and the interface that all ray casters
//! share.
//!
//! `OctreeParameters::default` is tuned for [`HostTracer`]. [`Octree::traverse`](octree::Octree::traverse) with
//! [`HostTracer::nearest_in`], and [`HostTracer::nearest_of_all`] without an octree, are the plain references for tests
//! of the fast forms; [`crate::geom::exact`] decides whether a hit is correct.

mod best;
mod cast;
mod host_tracer;
pub mod octree;
pub mod offset;
mod packet;
pub mod scale;
pub mod triangle_test;

pub use best::Best;
pub use cast::{CastError, Caster, is_occluder};
pub use host_tracer::{HostCounts, HostTracer};
