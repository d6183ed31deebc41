//! The executor on a GPU of the host, through wgpu (feature `wgpu`).
//!
//! - `adapter`: which adapters there are, and picking one by name; `error`: what can go wrong.
//! - `opened`: an opened adapter: buffers, compute pipelines, dispatches, read-back.
//! - `probe`: what the adapter's own single precision gives, beside IEEE 754 and WGSL. `testing`: what tests do
//!   without an adapter.
//! - `board`: the buffers of an emulated card.
//!
//! Nothing here decides a bit: the shaders do (`refsim::exec::wgsl`), from storage buffers of 32-bit words.

mod adapter;
mod board;
mod error;
mod opened;
mod probe;
pub mod testing;

pub use adapter::{Adapter, AdapterKind, adapters};
pub use board::{BINDINGS, Board, LoadedProgram};
pub use error::GpuError;
pub use opened::{Access, Buffer, CompileObserver, Gpu, Kernel, Pipeline};
pub use probe::{FULL as FULL_PROBE, OperationReport, ProbeDifference, ProbeReport, Tally, probe};
