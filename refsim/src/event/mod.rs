//! Counters and logs of draws: the only input of the timing model.
//!
//! Counts are integer sums, so they are the same for every thread count and executor.
//!
//! A machine with recording enabled (see [`crate::machine`]) logs every upload, draw, read-back and fence as an
//! [`Event`], in the order of the calls. A draw's [`DrawRecord`] holds its instruction mix ([`ProgramWork`]), its
//! resources and, if textures were observed, the cache traffic of its texel reads ([`SamplerTraffic`]).

mod counts;
mod host;
mod log;
mod program;
mod texels;
mod vertex_cache;

pub use counts::{ByteCounts, DrawEvents, FragmentCounts, PrimitiveCounts, SAMPLERS};
pub use host::HostOperation;
pub use log::{
    DepthRecord, DrawRecord, Event, FenceId, HostWork, MipmapLevel, MipmapRecord, ReadBackMode, ResourceId,
    SamplerRecord, TargetRecord,
};
pub use program::{ArithmeticSlot, FlowConstants, PhaseWork, ProgramWork, TextureSlot};
pub use texels::{SamplerTraffic, TexelObserver, TexelTouch};
pub use vertex_cache::vertex_cache_misses;
