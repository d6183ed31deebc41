//! Simulated texture cache: set-associative with LRU replacement.
//!
//! The cache geometry of these cards is unpublished, so the profile's is a guess. [`TextureCaches`] simulates half the
//! stated size, the stated size and twice the size at once, to show the sensitivity without drawing again.

use super::TimingError;
use crate::device::Profile;
use crate::event::{SAMPLERS, SamplerTraffic, TexelObserver, TexelTouch};
use std::collections::BTreeSet;

/// Smallest line size in bytes: the size of the largest texel.
const LEAST_LINE: u64 = 16;
/// Largest cache size in bytes, far beyond these cards.
const MAX_BYTES: u64 = 1 << 26;

/// A cache, initially empty.
#[derive(Clone, Debug)]
pub struct TextureCache {
    line_bytes: u64,
    ways: usize,
    sets: u64,
    /// Line numbers plus one, or 0 for an empty way. Stored set by set; within a set, most recently used first.
    lines: Vec<u64>,
}

impl TextureCache {
    /// Creates a cache of `bytes` with lines of `line_bytes` and associativity `ways`.
    ///
    /// # Errors
    /// [`TimingError::CacheShape`] unless lines are a power of two of at least 16 bytes and the size, at most 64 MiB,
    /// is a whole number of sets.
    pub fn new(bytes: u64, line_bytes: u64, ways: u64) -> Result<Self, TimingError> {
        let error = TimingError::CacheShape { bytes, line_bytes, ways };
        let set = line_bytes.checked_mul(ways).filter(|&set| set > 0).ok_or(error.clone())?;
        let fits = line_bytes.is_power_of_two() && line_bytes >= LEAST_LINE && bytes <= MAX_BYTES;
        if !fits || bytes == 0 || !bytes.is_multiple_of(set) {
            return Err(error);
        }
        let lines = vec![0; (bytes / line_bytes) as usize];
        Ok(Self { line_bytes, ways: ways as usize, sets: bytes / set, lines })
    }

    /// Requests the line of an address; loads it on a miss. Returns `true` on a hit.
    pub fn access(&mut self, address: u64) -> bool {
        let number = address / self.line_bytes;
        let set = (number % self.sets) as usize * self.ways;
        let Some(ways) = self.lines.get_mut(set..set + self.ways) else { return false };
        let mark = number + 1;
        let found = ways.iter().position(|&way| way == mark);
        // On a hit, the line moves to the front; on a miss, the last way is evicted.
        let last = found.unwrap_or(ways.len() - 1);
        ways[..=last].rotate_right(1);
        ways[0] = mark;
        found.is_some()
    }

    /// Invalidates all lines.
    pub fn clear(&mut self) {
        self.lines.fill(0);
    }

    /// Line size in bytes.
    pub fn line_bytes(&self) -> u64 {
        self.line_bytes
    }
}

/// Simulates a card's texture cache, shared by all samplers, at half its size, its size and twice its size. It is
/// invalidated at the start of each draw, because its contents could be stale, and drivers of the time invalidated it
/// on state changes.
#[derive(Clone, Debug)]
pub struct TextureCaches {
    caches: [TextureCache; 3],
    traffic: [SamplerTraffic; SAMPLERS],
    lines: [BTreeSet<u64>; SAMPLERS],
    /// Last line requested by each sampler; requesting it again is a hit.
    last: [Option<u64>; SAMPLERS],
}

impl TextureCaches {
    /// The texture cache of a device.
    ///
    /// # Errors
    /// [`TimingError::Missing`] if the device states no cache, [`TimingError::CacheShape`] if its shape is invalid.
    pub fn new(profile: &Profile) -> Result<Self, TimingError> {
        let figure = |figure: &'static str| {
            profile.rates.figure(figure).ok_or_else(|| TimingError::Missing {
                device: profile.name.clone(),
                figure,
                have: Profile::card_names().join(" "),
            })
        };
        let bytes = figure("texture_cache_bytes")?;
        let line = figure("texture_cache_line_bytes")?;
        let ways = figure("texture_cache_ways")?;
        let whole = TextureCache::new(bytes, line, ways)?;
        // If the cache has a single set, half the size means half the ways.
        let half =
            TextureCache::new(bytes / 2, line, ways).or_else(|_| TextureCache::new(bytes / 2, line, ways / 2))?;
        let double = TextureCache::new(bytes.saturating_mul(2), line, ways)?;
        Ok(Self {
            caches: [half, whole, double],
            traffic: [SamplerTraffic::default(); SAMPLERS],
            lines: std::array::from_fn(|_| BTreeSet::new()),
            last: [None; SAMPLERS],
        })
    }
}

impl TexelObserver for TextureCaches {
    fn begin(&mut self) {
        self.caches.iter_mut().for_each(TextureCache::clear);
        self.traffic = [SamplerTraffic::default(); SAMPLERS];
        self.lines.iter_mut().for_each(BTreeSet::clear);
        self.last = [None; SAMPLERS];
    }

    fn touch(&mut self, texel: &TexelTouch) {
        let sampler = usize::from(texel.sampler) % SAMPLERS;
        let traffic = &mut self.traffic[sampler];
        traffic.accesses += 1;
        for (cache, misses) in self.caches.iter_mut().zip(&mut traffic.misses) {
            *misses += u64::from(!cache.access(texel.address));
        }
        let line = texel.address / self.caches[1].line_bytes;
        // Consecutive accesses mostly hit the same line, so the hash set is skipped for them.
        if self.last[sampler] != Some(line) {
            self.last[sampler] = Some(line);
            self.lines[sampler].insert(line);
        }
    }

    fn end(&mut self) -> [SamplerTraffic; SAMPLERS] {
        for (traffic, lines) in self.traffic.iter_mut().zip(&self.lines) {
            traffic.distinct = lines.len() as u64;
        }
        self.traffic
    }
}
