//! Division of a tile's triangles among threads.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Triangles per piece, the unit of work if several workers share a tile.
pub(super) const PIECE: usize = 16;

/// The triangles of a tile in pieces. Threads take pieces from both ends, so that a thread that starts late takes
/// fewer. All pieces taken from the front precede all pieces taken from the back.
pub(super) struct Pieces<'o> {
    order: &'o [u32],
    size: usize,
    left: Mutex<Range<usize>>,
}

impl<'o> Pieces<'o> {
    /// Creates pieces for several workers, or a single piece for one.
    pub(super) fn new(order: &'o [u32], workers: usize) -> Self {
        let size = if workers > 1 { PIECE } else { order.len().max(1) };
        Self { order, size, left: Mutex::new(0..order.len().div_ceil(size)) }
    }

    /// Number of threads, at most `workers`, that can get at least one piece each.
    pub(super) fn workers(order: &[u32], workers: usize) -> usize {
        workers.min(order.len() / PIECE).max(1)
    }

    pub(super) fn first(&self) -> Option<(usize, &'o [u32])> {
        self.taken(Range::next)
    }

    pub(super) fn last(&self) -> Option<(usize, &'o [u32])> {
        self.taken(Range::next_back)
    }

    /// Takes a piece; returns its index and triangles.
    fn taken(&self, take: impl Fn(&mut Range<usize>) -> Option<usize>) -> Option<(usize, &'o [u32])> {
        let piece = take(&mut self.left.lock().unwrap_or_else(PoisonError::into_inner))?;
        let end = self.order.len().min((piece + 1) * self.size);
        Some((piece, &self.order[piece * self.size..end]))
    }
}
