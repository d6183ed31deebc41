//! Memory traffic of a draw.

use crate::device::Rates;
use crate::event::{DrawRecord, SamplerRecord};

/// Cache size assumed by a model. Draw records contain the misses for all sizes (for textures only if observed).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CacheSize {
    /// Half the size that the profile states.
    Half,
    /// The size that the profile states.
    #[default]
    Stated,
    /// Twice the size that the profile states.
    Double,
}

impl CacheSize {
    /// The count of this size among the counts of a draw record.
    pub(super) fn of(self, [half, stated, double]: [u64; 3]) -> u64 {
        match self {
            Self::Half => half,
            Self::Stated => stated,
            Self::Double => double,
        }
    }
}

/// Bytes moved between the card and its memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Texture bytes: cache lines fetched, or an estimate for draws that were not observed.
    pub textures: u64,
    /// Number of texture cache misses; 0 for draws that were not observed.
    pub misses: u64,
    /// Depth bytes, read and written.
    pub depth: u64,
    /// Colour bytes, read and written.
    pub color: u64,
    /// Vertex bytes.
    pub vertices: u64,
}

impl Traffic {
    /// Total bytes.
    pub fn total(&self) -> u64 {
        [self.textures, self.depth, self.color, self.vertices].into_iter().fold(0, u64::saturating_add)
    }
}

/// Memory traffic of a draw, for given sizes of the texture cache and the post-transform vertex cache. Every depth and
/// colour access counts, and every processed vertex; compression and early depth rejection are not modelled. Texture
/// traffic is missed cache lines; for draws that were not observed, compulsory misses are estimated.
pub fn traffic(draw: &DrawRecord, rates: &Rates, (cache, vertex_cache): (CacheSize, CacheSize)) -> Traffic {
    let bytes = &draw.counts.bytes;
    let line = rates.texture_cache_line_bytes.unwrap_or(1);
    let misses = |s: &SamplerRecord| s.traffic.map(|seen| cache.of(seen.misses));
    let observed = draw.is_observed();
    let missed = if observed { draw.samplers.iter().filter_map(misses).fold(0, u64::saturating_add) } else { 0 };
    Traffic {
        textures: if observed { missed.saturating_mul(line) } else { estimate(draw, rates) },
        misses: missed,
        depth: bytes.depth_read.saturating_add(bytes.depth_written),
        color: bytes.color_read.saturating_add(bytes.color_written),
        vertices: fetched(draw, vertex_cache),
    }
}

/// Bytes of the vertices processed; vertices that have left the cache are fetched again.
fn fetched(draw: &DrawRecord, cache: CacheSize) -> u64 {
    let (bytes, run) = (u128::from(draw.counts.bytes.vertices), u128::from(cache.of(draw.vertices_run)));
    u64::try_from((bytes * run).div_ceil(u128::from(draw.counts.vertices.max(1)))).unwrap_or(u64::MAX)
}

/// Estimates the bytes of compulsory misses. If all textures of the draw fit into the cache, each texel is fetched
/// once, else once per primitive. At most one texel per read is fetched, because the other texels of a filter hit the
/// cache.
fn estimate(draw: &DrawRecord, rates: &Rates) -> u64 {
    let read = |s: &&SamplerRecord| draw.fetches(s.sampler) > 0;
    let size = draw.samplers.iter().filter(read).fold(0_u64, |sum, s| sum.saturating_add(s.texture_bytes));
    let fits = size <= rates.texture_cache_bytes.unwrap_or_default();
    let times = if fits { 1 } else { draw.counts.primitives.rasterised };
    draw.samplers.iter().fold(0, |sum, s| {
        let read = draw.fetches(s.sampler).saturating_mul(s.texel_bytes.into());
        sum.saturating_add(read.min(s.texture_bytes.saturating_mul(times)))
    })
}
