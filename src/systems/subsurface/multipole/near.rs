//! Factors of near texels: both texels' parts are divided into quarters until their pieces are far; long texels are
//! left to [`super::long`].

use std::collections::BTreeMap;

use glam::DVec3;

use super::face_map::{FaceMap, Window};
use super::kernel::{DistanceTable, add};
use super::long::long_mean;
use super::moments::Moments;
use super::surface::SurfaceMoments;

/// Maximum number of halvings of a texel's side; texels that need more are long.
const MAX_HALVINGS: u32 = 4;
/// Number of texels whose pieces are cached; a power of two.
const SLOTS: usize = 4096;

/// Number of cached means of pairs.
const PAIRS: usize = 1 << 16;

/// Cache of pieces of recent near texels, and of means of pairs with many pieces, which both texels need.
#[derive(Clone, Debug)]
pub(super) struct PieceCache<const N: usize> {
    slots: Vec<TexelPieces>,
    means: BTreeMap<[usize; 2], [f64; N]>,
}

/// The pieces of one texel: 4^k after k halvings; the quarters of a piece are adjacent.
#[derive(Clone, Debug)]
struct TexelPieces {
    texel: usize,
    halvings: Vec<Vec<Moments>>,
}

/// An index that no texel has.
const NONE: usize = usize::MAX;

impl<const N: usize> PieceCache<N> {
    pub(super) fn new() -> Self {
        Self { slots: vec![TexelPieces { texel: NONE, halvings: Vec::new() }; SLOTS], means: BTreeMap::new() }
    }

    /// Ensures that a texel's pieces are cached, and returns their slot.
    fn fetch(&mut self, surface: &SurfaceMoments, texel: usize, halvings: u32) -> usize {
        let slot = texel % SLOTS;
        let kept = &mut self.slots[slot];
        if kept.texel != texel || kept.halvings.len() <= halvings as usize {
            kept.fill(surface, texel, halvings);
        }
        slot
    }
}

impl TexelPieces {
    fn fill(&mut self, surface: &SurfaceMoments, texel: usize, halvings: u32) {
        let (face, window) = surface.window(texel);
        let whole = surface.level(0)[texel];
        self.texel = texel;
        self.halvings.resize_with(halvings as usize + 1, Vec::new);
        self.halvings.iter_mut().for_each(Vec::clear);
        self.halvings[0].push(whole);
        let (mut windows, mut area) = (vec![window], whole.area);
        for pieces in &mut self.halvings[1..] {
            area *= 0.25;
            pieces.extend(windows.iter().flat_map(|window| quarters(face, *window, area)));
            windows = windows.iter().flat_map(Window::quarters).collect();
        }
    }
}

fn quarters(face: &FaceMap, window: Window, area: f64) -> [Moments; 4] {
    let windows = window.quarters();
    if window.is_bent() {
        return windows.map(|quarter| face.moments(quarter, area));
    }
    // Quarters of a parallelogram are congruent.
    let first = face.moments(windows[0], area);
    let [right, down] = [1, 2].map(|k| face.step(&windows[0], &windows[k]));
    [DVec3::ZERO, right, down, right + down].map(|step| Moments { point: first.point + step, ..first })
}

/// A pair of texels with their cached pieces.
struct Pair<'a, const N: usize> {
    kernel: &'a DistanceTable<N>,
    from: &'a [Vec<Moments>],
    to: &'a [Vec<Moments>],
    halvings: usize,
}

/// The mean of R_d over the pairs of points of two texels' parts, by Morton index, with equal bits in either order.
pub(super) fn texel_mean<const N: usize>(
    surface: &SurfaceMoments,
    kernel: &DistanceTable<N>,
    [one, other]: [usize; 2],
    cache: &mut PieceCache<N>,
) -> [f64; N] {
    let [from, to] = [one.min(other), one.max(other)];
    let [p, q] = [from, to].map(|texel| &surface.level(0)[texel]);
    let halvings = kernel.halvings(p, q);
    if halvings <= 1 {
        return quartered_mean(surface, kernel, [from, to], halvings, cache);
    }
    if let Some(mean) = cache.means.get(&[from, to]) {
        return *mean;
    }
    let mean = if halvings > MAX_HALVINGS && p.area > 0.0 && q.area > 0.0 {
        long_mean(surface, kernel, [from, to])
    } else {
        quartered_mean(surface, kernel, [from, to], halvings.min(MAX_HALVINGS), cache)
    };
    if cache.means.len() == PAIRS {
        cache.means.clear();
    }
    cache.means.insert([from, to], mean);
    mean
}

/// The mean of R_d over the pairs of points of two texels' parts, by quarters.
fn quartered_mean<const N: usize>(
    surface: &SurfaceMoments,
    kernel: &DistanceTable<N>,
    [from, to]: [usize; 2],
    halvings: u32,
    cache: &mut PieceCache<N>,
) -> [f64; N] {
    let slots = [from, to].map(|texel| cache.fetch(surface, texel, halvings));
    let displaced = if slots[0] == slots[1] && from != to {
        // Both texels have the same slot, which now contains the second texel's pieces.
        let mut pieces = TexelPieces { texel: NONE, halvings: Vec::new() };
        pieces.fill(surface, from, halvings);
        Some(pieces)
    } else {
        None
    };
    let from = &displaced.as_ref().unwrap_or(&cache.slots[slots[0]]).halvings;
    Pair { kernel, from, to: &cache.slots[slots[1]].halvings, halvings: halvings as usize }
        .mean(Piece::WHOLE, Piece::WHOLE)
}

impl<const N: usize> Pair<'_, N> {
    fn mean(&self, from: Piece, to: Piece) -> [f64; N] {
        let (p, q) = (&self.from[from.halvings][from.index], &self.to[to.halvings][to.index]);
        if let Some(mean) = self.kernel.mean(p, q) {
            return mean;
        }
        // The larger piece is divided.
        let [from_last, to_last] = [from, to].map(|piece| piece.halvings == self.halvings);
        if from_last && to_last {
            return self.kernel.mean_of_last(p, q);
        }
        let mut sum = [0.0; N];
        if to_last || (!from_last && p.size_squared >= q.size_squared) {
            from.quarters().for_each(|quarter| add(&mut sum, &self.mean(quarter, to)));
        } else {
            to.quarters().for_each(|quarter| add(&mut sum, &self.mean(from, quarter)));
        }
        sum.map(|sum| 0.25 * sum)
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
struct Piece {
    halvings: usize,
    index: usize,
}

impl Piece {
    const WHOLE: Self = Self { halvings: 0, index: 0 };

    fn quarters(self) -> impl Iterator<Item = Self> {
        (4 * self.index..4 * self.index + 4).map(move |index| Self { halvings: self.halvings + 1, index })
    }
}
