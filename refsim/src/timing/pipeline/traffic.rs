//! What a draw moves to and from memory.

use crate::device::Rates;
use crate::event::{DrawRecord, SamplerRecord, SamplerTraffic};

/// Which size of a cache a model takes: the record of a draw knows them all, those of textures if it was observed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CacheSize {
    /// Of half the size that the profile states.
    Half,
    /// As the profile states.
    #[default]
    Stated,
    /// Of twice the size.
    Double,
    /// None: every access fetches a line.
    None,
}

impl CacheSize {
    /// Lines that one sampler fetched.
    fn misses(self, seen: &SamplerTraffic) -> u64 {
        let [half, stated, double] = seen.misses;
        match self {
            Self::Half => half,
            Self::Stated => stated,
            Self::Double => double,
            Self::None => seen.requests,
        }
    }

    /// Vertices that are processed.
    pub(super) fn vertices_run(self, draw: &DrawRecord) -> u64 {
        let [half, stated, double] = draw.vertices_run;
        match self {
            Self::Half => half,
            Self::Stated | Self::None => stated,
            Self::Double => double,
        }
    }
}

/// Bytes between the card and its memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Texels: cache lines fetched, or the estimate where the draw was not observed.
    pub textures: u64,
    /// Cache lines among them; 0 where the draw was not observed.
    pub misses: u64,
    /// Depth, read and written.
    pub depth: u64,
    /// Colour, read and written.
    pub color: u64,
    /// Vertices.
    pub vertices: u64,
}

impl Traffic {
    /// All of it.
    pub fn total(&self) -> u64 {
        [self.textures, self.depth, self.color, self.vertices].into_iter().fold(0, u64::saturating_add)
    }
}

/// The traffic of a draw, with its texture cache and its cache of finished vertices. Depth and colour move once an
/// access, vertices each time that they are processed: these cards' compression and early rejection
/// are not modelled. Textures move by cache lines that the simulated cache missed; of a draw that was not observed an
/// estimate is taken: compulsory misses.
pub fn traffic(draw: &DrawRecord, rates: &Rates, (cache, vertex_cache): (CacheSize, CacheSize)) -> Traffic {
    let bytes = &draw.counts.bytes;
    let line = rates.texture_cache_line_bytes.unwrap_or(1);
    let misses = |s: &SamplerRecord| s.traffic.map(|seen| cache.misses(&seen));
    let observed = draw.is_observed();
    let missed = if observed { draw.samplers.iter().filter_map(misses).fold(0, u64::saturating_add) } else { 0 };
    Traffic {
        textures: if observed { missed.saturating_mul(line) } else { estimate(draw, rates, cache) },
        misses: missed,
        depth: bytes.depth_read.saturating_add(bytes.depth_written),
        color: bytes.color_read.saturating_add(bytes.color_written),
        vertices: fetched(draw, vertex_cache),
    }
}

/// Bytes of the vertices that are processed: those not kept are fetched again.
fn fetched(draw: &DrawRecord, cache: CacheSize) -> u64 {
    let (bytes, run) = (u128::from(draw.counts.bytes.vertices), u128::from(cache.vertices_run(draw)));
    u64::try_from((bytes * run).div_ceil(u128::from(draw.counts.vertices.max(1)))).unwrap_or(u64::MAX)
}

/// Without a cache each read fetches a line. With one there are compulsory misses: if all textures that the draw reads
/// fit into the cache, each of their texels comes once; if not, each comes once for every primitive. Never more than
/// one texel for each read: a filter finds its neighbours in the cache.
fn estimate(draw: &DrawRecord, rates: &Rates, cache: CacheSize) -> u64 {
    if cache == CacheSize::None {
        let line = rates.texture_cache_line_bytes.unwrap_or(1);
        return draw.samplers.iter().fold(0, |sum, s| sum.saturating_add(draw.fetches(s.sampler).saturating_mul(line)));
    }
    let read = |s: &&SamplerRecord| draw.fetches(s.sampler) > 0;
    let size = draw.samplers.iter().filter(read).fold(0_u64, |sum, s| sum.saturating_add(s.texture_bytes));
    let fits = size <= rates.texture_cache_bytes.unwrap_or_default();
    let times = if fits { 1 } else { draw.counts.primitives.rasterised };
    draw.samplers.iter().fold(0, |sum, s| {
        let read = draw.fetches(s.sampler).saturating_mul(s.texel_bytes.into());
        sum.saturating_add(read.min(s.texture_bytes.saturating_mul(times)))
    })
}
