//! The batch executor: executes programs on whole tiles of fragments with the host's SIMD instructions. It is
//! bit-identical to [`super::scalar`] and shares no arithmetic with it; tested by `tests/agree` and
//! `refsim/tests/batch/lanes.rs`.
//!
//! - The package `refsim-lanes`: arithmetic of number formats on rows. `formats`: the formats of a program. `schedule`:
//!   schedules the graph of `super::lower` as steps. `run`: executes steps on rows.
//! - `vertex`: from attributes to triangles. `tile`: from triangles to targets.
//! - `cache`: caches of decoded data; [`BatchExecutor`]: their owner.
//!
//! Values are rows of 256 lanes (`[u32; 256]` with host integers or floats) that are processed in plain loops. The SIMD
//! level is selected once per run of lane operations ([`SimdLevel`]), by the `multiversion` crate. No unsafe code.

mod cache;
mod executor;
mod formats;
mod run;
mod schedule;
mod tile;
mod vertex;

pub use executor::BatchExecutor;
pub use refsim_lanes::{ArrayOperation, MatrixColumns, MatrixRows, SimdLevel, convert, evaluate, exact_dot};
pub use tile::{BatchTiles, TileRound};
pub use vertex::{AttributeRows, BatchVertices, Instances, Surfaces, VertexRows};
