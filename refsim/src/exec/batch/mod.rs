//! The batch executor: programs on whole tiles of fragments, in vector code of the host. Equal to
//! [`super::scalar`] bit for bit; `tests/agree` and `refsim/tests/agree_lanes.rs` prove it. They share no arithmetic.
//!
//! - `lanes`: the arithmetic of number formats. `schedule`: the graph of `super::lower` as steps. `run`: the steps on
//!   rows.
//! - `vertex`: from attributes to triangles. `tile`: from triangles to targets.
//! - `cache`: what was decoded; [`BatchExecutor`]: who owns it.
//!
//! Values are rows of 256 lanes (`[u32; 256]` holding host integers or floats), loops over them are plain, and the
//! vector width is chosen once per run of lane operations ([`SimdLevel`]), by the `multiversion` crate. No unsafe code.

mod cache;
mod executor;
mod lanes;
mod run;
mod schedule;
mod tile;
mod vertex;

pub use executor::BatchExecutor;
pub use lanes::{SimdLevel, convert, evaluate, exact_dot};
pub use tile::{BatchTiles, BatchTracer, TileRound};
pub use vertex::{AttributeRows, BatchVertices, Instances, Surfaces, VertexRows};
