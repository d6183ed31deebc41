//! Texel reads in order, and the interface of their observers.

use std::fmt;

/// One texel read by one covered fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TexelTouch {
    /// The sampler.
    pub sampler: u8,
    /// First byte in the memory of the card.
    pub address: u64,
    /// Bytes of the texel, 1 to 16. A texel never lies across a boundary of its own size rounded up to a power of two.
    pub bytes: u32,
}

/// What became of the texels that one sampler touched in one draw.
///
/// An access is one texel for one fragment: a bilinear read makes four. A request is one cache line for one access.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SamplerTraffic {
    /// Texels read.
    pub accesses: u64,
    /// Cache lines asked for.
    pub requests: u64,
    /// Requests that the cache had to fetch from memory, at half the cache's size, at its size, and at twice its size.
    pub misses: [u64; 3],
    /// Different lines asked for: what a cache without limit would fetch.
    pub distinct: u64,
}

/// Told of every texel that the covered fragments of a draw touch, in the order of the card: primitive by primitive,
/// tile by tile within, quad by quad, instruction by instruction, lane by lane.
///
/// The timing model's texture cache is one. An observer cannot change a pixel.
pub trait TexelObserver: fmt::Debug + Send + Sync {
    /// A draw begins.
    fn begin(&mut self);

    /// A texel is touched.
    fn touch(&mut self, texel: &TexelTouch);

    /// The draw has ended: what became of the touches, by sampler.
    fn end(&mut self) -> [SamplerTraffic; super::SAMPLERS];
}
