//! Rays on the host: the octree, first hits and any hits in single precision, and the interface that all ray casters
//! share.
//!
//! - [`Caster`]: first hits ([`Caster::cast`]) and any hits ([`Caster::occluded`]) for bundles of rays;
//! - [`HostTracer`]: the octree walked front to back, triangles tested eight at a time, rays shared out to all threads;
//! - [`octree`]: cells, traversal, beams of rays;
//! - [`offset`]: how far off a surface rays start and end.
//!
//! `OctreeParameters::default` is tuned for this tracer. [`Octree::traverse`](octree::Octree::traverse) with
//! [`HostTracer::nearest_in`], and [`HostTracer::nearest_of_all`] without an octree, are the plain forms that the fast
//! ones are tested against; whether a hit is *true* is decided by [`crate::geom::exact`].

mod best;
mod cast;
mod host_tracer;
pub mod octree;
pub mod offset;
mod packet;
pub(crate) mod scale;
pub(crate) mod triangle_test;

pub(crate) use best::Best;
pub use cast::{CastError, Caster, is_occluder};
pub use host_tracer::{HostCounts, HostTracer};
