//! Division of a tile's triangles among threads.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Triangles per piece, the unit of work if several workers share a tile.
const PIECE: usize = 16;

/// The triangles of a tile in pieces, which threads take from both ends, so that a late thread takes fewer. All pieces
/// taken from the front precede all those taken from the back.
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

    /// Number of `workers` that get at least one piece each.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_from_both_ends_are_all_of_them() {
        let order: Vec<u32> = (0..3 * PIECE as u32 + 5).collect();
        let pieces = Pieces::new(&order, 2);
        let ([front, then], back) = ([pieces.first(), pieces.first()], [pieces.last(), pieces.last(), pieces.last()]);
        assert_eq!(front, Some((0, &order[..PIECE])));
        assert_eq!(back, [Some((3, &order[3 * PIECE..])), Some((2, &order[2 * PIECE..3 * PIECE])), None]);
        assert_eq!((then, pieces.first()), (Some((1, &order[PIECE..2 * PIECE])), None));
        assert_eq!(Pieces::new(&order, 1).first(), Some((0, &order[..])));
        assert_eq!(Pieces::new(&[], 1).first(), None);
        assert_eq!([2, 9].map(|workers| Pieces::workers(&order, workers)), [2, 3]);
    }
}
