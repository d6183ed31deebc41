//! Executor on a GPU of the host, through wgpu (feature `wgpu`).
//!
//! - `adapter`: enumeration and selection of adapters; `error`: errors.
//! - `opened`: an opened adapter: buffers, compute pipelines, dispatches, read-back.
//! - `testing`: access to an adapter for tests.
//! - `board`: the GPU buffers of an emulated card.
//!
//! Only the shaders (`refsim::exec::wgsl`) determine results; they operate on storage buffers of 32-bit words.

mod adapter;
mod arena;
mod board;
mod error;
mod opened;
pub mod testing;

#[doc(hidden)]
pub use adapter::choose;
pub use adapter::{Adapter, AdapterKind, adapters};
pub use board::{BINDINGS, Board, LoadedProgram};
pub use error::GpuError;
pub use opened::{Access, Buffer, CompileObserver, Gpu, Kernel, Pipeline};
