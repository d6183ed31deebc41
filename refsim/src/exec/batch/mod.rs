//! The batch executor: programs on whole tiles of fragments, in vector code of the host. Equal to
//! [`super::scalar`] bit for bit; `tests/agree` and `refsim/tests/agree_lanes.rs` prove it. They share no arithmetic.
//!
//! - `lane`: what an arithmetic has to offer; `fixed`, `ieee`, `float`: in host integers and host floats; `odd`,
//!   `power`: exact results squeezed into doubles; `lanes`: which format gets which.
//! - `fuse`, `schedule`: the graph of `super::lower` as steps on `slots`, without what nothing reads, and with what only one
//!   operation reads as part of that; `formats`: its formats bound to arithmetic.
//! - `ops`, `loops`, `steps`, `fetch`, `stored`: carrying the steps out, 256 lanes at a time.
//! - `vertex`, `build`, `surfaces`: from attributes to triangles, in rows.
//! - `raster`, `shader`, `output`, `store`, `targets`: what happens to a tile around the steps.
//! - `program`, `flow`, `flow_run`: programs without and with flow control; `tile`, `trace`: the ways in; `cache`: what was decoded.
//!
//! Values are rows of 256 lanes (`[u32; 256]` holding host integers or floats), loops over them are plain, and the
//! vector width is chosen once for each run of lane operations ([`SimdLevel`]), by the `multiversion` crate. No unsafe code.

mod build;
mod cache;
mod evaluate;
mod fetch;
mod fixed;
mod float;
mod flow;
mod flow_run;
mod formats;
mod fuse;
mod ieee;
mod lane;
mod lanes;
mod loops;
mod odd;
mod ops;
mod output;
mod pack;
mod power;
mod program;
mod raster;
mod schedule;
mod shader;
mod simd;
mod slots;
mod steps;
mod store;
mod stored;
mod surfaces;
mod targets;
mod tile;
mod trace;
mod vertex;
mod window;

pub use build::Instances;
pub use evaluate::{LaneOperation, convert, evaluate};
pub use simd::SimdLevel;
pub use surfaces::Surfaces;
pub use tile::{BatchTiles, Round};
pub use trace::BatchTracer;
pub use vertex::{AttributeRows, BatchVertices, VertexRows};
