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
mod settings;
mod tally;

pub use body::{half_space, sphere};
pub use boundary::PhotonEntry;
pub use mesh::mesh;
pub use settings::PhotonWalk;
pub use tally::{BATCHES, WalkEstimate, WalkTally};
