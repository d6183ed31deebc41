//! Rays on the host: the octree, first hits and any hits in single precision, and the interface that all ray casters
//! share.
//!
//! - [`Caster`]: first hits ([`Caster::cast`]) and any hits ([`Caster::occluded`]) for bundles of rays;
//! - [`HostTracer`]: front-to-back traversal, triangles tested eight at a time, rays distributed over all threads;
//! - [`octree`]: cells, traversal, beams of rays;
//! - [`offset`]: offsets of ray ends from surfaces.
//!
//! `OctreeParameters::default` is tuned for this tracer. [`Octree::traverse`](octree::Octree::traverse) with
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
