//! The executor on a GPU of the host, through wgpu (feature `wgpu`).
//!
//! - `adapter`: which adapters there are, and picking one by name; `error`: what can go wrong.
//! - `device`: an opened adapter: buffers, compute pipelines, dispatches, read-back.
//! - `probe`: whether the adapter's own single precision is exact. `testing`: what tests do without an adapter.
//! - `board`: the buffers of an emulated card.
//!
//! Nothing here decides a bit: the shaders do (`refsim::exec::wgsl`), from storage buffers of 32-bit words.

mod adapter;
mod board;
mod device;
mod error;
mod probe;
pub mod testing;

pub use adapter::{Adapter, AdapterKind, adapters};
pub use board::{Board, Shader};
pub use device::{Access, Buffer, Gpu, Pipeline};
pub use error::GpuError;
pub use probe::{Difference, FULL as FULL_PROBE, OperationReport, ProbeReport, Tally, probe};
