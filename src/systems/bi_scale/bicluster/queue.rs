//! Lines in buckets by their key, the best key first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Lines ordered by key; of equal keys the lowest line comes first. Outdated entries, whose line has another key by now
/// or is no longer a candidate, are skipped when they come up, so that a line may be in several buckets.
#[derive(Debug, Default)]
pub(super) struct BucketQueue {
    buckets: Vec<BinaryHeap<Reverse<u32>>>,
    /// No bucket outside of these has lines.
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
        while self.end > self.lowest {
            let key = self.end - 1;
            if let Some(line) = first(&mut self.buckets[key], |line| is_current(key as u32, line)) {
                return Some((key as u32, line));
            }
            self.end -= 1;
        }
        (self.lowest, self.end) = (0, 0);
        None
    }

    /// The line of the lowest key, likewise.
    pub(super) fn lowest(&mut self, is_current: impl Fn(u32, u32) -> bool) -> Option<(u32, u32)> {
        while self.lowest < self.end {
            let key = self.lowest;
            if let Some(line) = first(&mut self.buckets[key], |line| is_current(key as u32, line)) {
                return Some((key as u32, line));
            }
            self.lowest += 1;
        }
        (self.lowest, self.end) = (0, 0);
        None
    }

    pub(super) fn clear(&mut self) {
        self.buckets[self.lowest..self.end].iter_mut().for_each(BinaryHeap::clear);
        (self.lowest, self.end) = (0, 0);
    }
}

/// The lowest line that is current; what comes before it goes.
fn first(bucket: &mut BinaryHeap<Reverse<u32>>, is_current: impl Fn(u32) -> bool) -> Option<u32> {
    while let Some(&Reverse(line)) = bucket.peek() {
        if is_current(line) {
            return Some(line);
        }
        bucket.pop();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn best_keys_and_lowest_lines_come_first() {
        let mut queue = BucketQueue::default();
        assert_eq!(queue.highest(|_, _| true), None);
        for (key, line) in [(3, 5), (7, 9), (7, 2), (1, 4), (3, 1)] {
            queue.push(key, line);
        }
        assert_eq!(queue.highest(|_, _| true), Some((7, 2)));
        assert_eq!(queue.highest(|_, line| line != 2), Some((7, 9)));
        assert_eq!(queue.lowest(|_, line| line != 4), Some((3, 1)));
        assert_eq!(queue.highest(|key, _| key != 7), Some((3, 1)));
        queue.push(8, 6);
        assert_eq!(queue.highest(|_, _| true), Some((8, 6)));
        queue.clear();
        assert_eq!(queue.lowest(|_, _| true), None);
        queue.push(2, 3);
        assert_eq!((queue.lowest(|_, _| true), queue.highest(|_, _| true)), (Some((2, 3)), Some((2, 3))));
    }
}
