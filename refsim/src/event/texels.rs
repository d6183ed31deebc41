//! Texel reads in the card's order, and the interface for observing them.

use std::fmt;

/// One texel read by one covered fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TexelTouch {
    /// The sampler.
    pub sampler: u8,
    /// Byte address in the card's memory.
    pub address: u64,
    /// Texel size in bytes, 1 to 16. A texel never crosses a multiple of its size, rounded up to a power of two.
    pub bytes: u32,
}

/// Cache traffic of one sampler in one draw.
///
/// An access reads one texel for one fragment, from one cache line; a bilinear read makes four accesses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SamplerTraffic {
    /// Texels read.
    pub accesses: u64,
    /// Accesses that missed, with caches of half the profile's size, its size, and twice its size.
    pub misses: [u64; 3],
    /// Number of different lines read: the misses of an unlimited cache.
    pub distinct: u64,
}

/// Observes every texel read by the covered fragments of a draw, in the card's order: by primitive, then tile, quad,
/// instruction and lane.
///
/// Implemented by the timing model's texture cache. Observers cannot change pixels.
pub trait TexelObserver: fmt::Debug + Send + Sync {
    /// Called when a draw begins.
    fn begin(&mut self);

    /// Called for every texel read.
    fn touch(&mut self, texel: &TexelTouch);

    /// Called when the draw ends; returns the traffic by sampler.
    fn end(&mut self) -> [SamplerTraffic; super::SAMPLERS];
}
