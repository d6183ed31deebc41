//! Allocation of words in a buffer.

/// Allocator of words in `video`.
#[derive(Debug, Default)]
pub(super) struct Arena {
    pub(super) end: usize,
    /// Free ranges below `end` in ascending order: first word, length.
    holes: Vec<(usize, usize)>,
}

impl Arena {
    /// Allocates the lowest free range; returns its first word.
    pub(super) fn take(&mut self, words: usize) -> usize {
        if let Some(i) = self.holes.iter().position(|hole| hole.1 >= words) {
            let (base, length) = self.holes[i];
            if length == words {
                self.holes.remove(i);
            } else {
                self.holes[i] = (base + words, length - words);
            }
            return base;
        }
        let base = self.end;
        self.end += words;
        base
    }

    pub(super) fn give(&mut self, base: usize, words: usize) {
        let i = self.holes.partition_point(|hole| hole.0 < base);
        self.holes.insert(i, (base, words));
        // Merges adjacent holes; a hole at the end is removed.
        let mut merged: Vec<(usize, usize)> = Vec::with_capacity(self.holes.len());
        for &(base, words) in &self.holes {
            match merged.last_mut() {
                Some(last) if last.0 + last.1 == base => last.1 += words,
                _ => merged.push((base, words)),
            }
        }
        if merged.last().is_some_and(|last| last.0 + last.1 == self.end) {
            self.end = merged.pop().map_or(self.end, |last| last.0);
        }
        self.holes = merged;
    }
}
