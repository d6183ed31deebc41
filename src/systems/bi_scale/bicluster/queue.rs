//! Lines in buckets by their key, best key first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Lines ordered by key; among equal keys the lowest line comes first. A line may be in several buckets: outdated
/// entries, whose line has a new key or is no longer a candidate, are skipped when they are reached.
#[derive(Debug, Default)]
pub(super) struct BucketQueue {
    buckets: Vec<BinaryHeap<Reverse<u32>>>,
    /// Buckets below `lowest` and above `highest` are empty.
    lowest: usize,
    end: usize,
}

impl BucketQueue {
    pub(super) fn push(&mut self, key: u32, line: u32) {
        let key = key as usize;
        if key >= self.buckets.len() {
            self.buckets.resize_with(key + 1, BinaryHeap::new);
        }
        self.buckets[key].push(Reverse(line));
        self.lowest = if self.end == 0 { key } else { self.lowest.min(key) };
        self.end = self.end.max(key + 1);
    }

    /// The line with the highest key, and the key. `is_current` returns true if a line still has this key and is a
    /// candidate.
    pub(super) fn highest(&mut self, is_current: impl Fn(u32, u32) -> bool) -> Option<(u32, u32)> {
        let found = self.first((self.lowest..self.end).rev(), is_current);
        self.end = found.map_or(0, |(key, _)| key as usize + 1);
        self.lowest = found.map_or(0, |_| self.lowest);
        found
    }

    pub(super) fn lowest(&mut self, is_current: impl Fn(u32, u32) -> bool) -> Option<(u32, u32)> {
        let found = self.first(self.lowest..self.end, is_current);
        self.lowest = found.map_or(0, |(key, _)| key as usize);
        self.end = found.map_or(0, |_| self.end);
        found
    }

    /// Finds the first of the given keys that has a current line, and its lowest current line. Outdated entries before
    /// that line are removed.
    fn first(
        &mut self,
        mut keys: impl Iterator<Item = usize>,
        is_current: impl Fn(u32, u32) -> bool,
    ) -> Option<(u32, u32)> {
        keys.find_map(|key| {
            let bucket = &mut self.buckets[key];
            while let Some(&Reverse(line)) = bucket.peek() {
                if is_current(key as u32, line) {
                    return Some((key as u32, line));
                }
                bucket.pop();
            }
            None
        })
    }

    pub(super) fn clear(&mut self) {
        self.buckets[self.lowest..self.end].iter_mut().for_each(BinaryHeap::clear);
        (self.lowest, self.end) = (0, 0);
    }
}
