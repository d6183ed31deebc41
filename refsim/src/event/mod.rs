//! Counters and logs of draws: the only input of the timing model.
//!
//! Counts are sums of whole numbers, so they are the same for every thread count and every executor. They say how
//! much work a card would have had, never how long it took: that is the timing model's question.
//!
//! A machine that is asked to ([`crate::machine`]'s `record`) writes down every upload, draw, read-back and fence as an
//! [`Event`], in the order of the calls. A draw's [`DrawRecord`] says what its programs are made of ([`ProgramWork`]),
//! what it read and wrote, and, if textures were observed, what became of every texel that its fragments touched
//! ([`SamplerTraffic`]).

mod counts;
mod log;
mod program;
mod texels;
mod vertex_cache;

pub use counts::{ByteCounts, DrawEvents, FragmentCounts, PrimitiveCounts, SAMPLERS};
pub use log::{
    DepthRecord, DrawRecord, Event, FenceId, FilterKind, HostWork, MipKind, MipmapLevel, MipmapRecord, ReadBackMode,
    ResourceId, SamplerRecord, TargetRecord,
};
pub use program::{ArithmeticSlot, FlowConstants, PhaseWork, ProgramWork, TextureSlot};
pub use texels::{SamplerTraffic, TexelObserver, TexelTouch};
pub use vertex_cache::vertex_cache_misses;
