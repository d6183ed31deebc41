//! Factors of near texels of which one is a sliver: both are cut across their longest extent until their pieces are
//! far.
//!
//! Quarters of a sliver are slivers, and a sliver of length L and width w has (L / w)^2 of them that are compact. Cuts
//! across its length make L / w.

use glam::DVec3;

use super::clip::clip;
use super::kernel::{DistanceTable, add};
use super::moments::{Covariance, Moments, size_squared};
use super::surface::SurfaceMoments;

/// The least mean squared distance from the mean point of a sliver, over its area: a rectangle of 10 : 1. Compact
/// texels beside each other keep one rule, by which one gets what the other loses.
const LEAST_SPREAD: f64 = 5.0 / 6.0;
/// Pieces are cut at most this often.
const MAX_CUTS: u32 = 20;
/// Texels that together need more pieces are left to quarters, as they would take seconds per pair.
const MAX_PIECES: f64 = 32768.0;
/// No piece has this index.
const NONE: u32 = u32::MAX;

/// Returns `true` if a texel is much longer than wide.
pub(super) fn is_sliver(texel: &Moments) -> bool {
    texel.covariance.trace() > LEAST_SPREAD * texel.area
}

/// A convex piece of a texel.
#[derive(Clone, Debug)]
struct Piece {
    outline: Vec<DVec3>,
    moments: Moments,
    /// How often the texel was cut for it.
    cuts: u32,
    /// The first of its two halves.
    halves: u32,
}

impl Piece {
    fn new(outline: Vec<DVec3>, cuts: u32) -> Self {
        Self { moments: of_outline(&outline), outline, cuts, halves: NONE }
    }
}

/// A pair of texels and their pieces, of which the first is the texel; the same ones twice for a texel and itself.
struct SliverPair<'a, const N: usize> {
    kernel: &'a DistanceTable<N>,
    pieces: [Vec<Piece>; 2],
    is_same: bool,
}

/// The mean of R_d over the pairs of points of two near texels, by Morton index. `None` if one has no area, or if they
/// need more than [`MAX_PIECES`].
pub(super) fn sliver_mean<const N: usize>(
    surface: &SurfaceMoments,
    kernel: &DistanceTable<N>,
    [from, to]: [usize; 2],
) -> Option<[f64; N]> {
    let pieces = [from, to].map(|texel| {
        let (face, window) = surface.window(texel);
        let halves = face.outlines(window).map(|outline| Piece::new(outline, 1));
        let area = halves.iter().map(|half| half.moments.area).sum();
        let texel = Moments { area, ..surface.level(0)[texel] };
        let [one, other] = halves;
        vec![Piece { outline: Vec::new(), moments: texel, cuts: 0, halves: 1 }, one, other]
    });
    let areas = pieces.each_ref().map(|pieces| pieces[0].moments.area);
    // A square's squared size is a sixth of its area.
    if (areas[0] + areas[1]) / (6.0 * MAX_PIECES) > 0.5 * kernel.nearest_reach() {
        return None;
    }
    let mut pair = SliverPair { kernel, pieces, is_same: from == to };
    let all = areas[0] * areas[1];
    (all > 0.0).then(|| pair.integral([0, 0]).map(|integral| integral / all))
}

impl<const N: usize> SliverPair<'_, N> {
    fn piece(&self, side: usize, index: u32) -> &Piece {
        &self.pieces[if self.is_same { 0 } else { side }][index as usize]
    }

    /// The integral over a piece of each texel.
    fn integral(&mut self, at: [u32; 2]) -> [f64; N] {
        let [p, q] = [0, 1].map(|side| self.piece(side, at[side]));
        let area = p.moments.area * q.moments.area;
        if area <= 0.0 {
            return [0.0; N];
        }
        let divides = |piece: &Piece| piece.cuts < MAX_CUTS;
        let larger = usize::from(q.moments.size_squared > p.moments.size_squared);
        let divided = [larger, 1 - larger].into_iter().find(|&side| divides([p, q][side]));
        let mean = match (self.kernel.mean(&p.moments, &q.moments), divided) {
            (Some(mean), _) => mean,
            (None, Some(side)) => {
                let first = self.halves(side, at[side]);
                let mut sum = [0.0; N];
                for half in [first, first + 1] {
                    let mut at = at;
                    at[side] = half;
                    add(&mut sum, &self.integral(at));
                }
                return sum;
            }
            (None, None) => match self.kernel.mean_of_last(&p.moments, &q.moments) {
                Some(mean) => mean,
                None if self.is_same && at[0] == at[1] => self.kernel.disc(p.moments.area),
                None => self.kernel.at(p.moments.point.distance_squared(q.moments.point)),
            },
        };
        mean.map(|mean| area * mean)
    }

    /// The first of the two halves of a piece, which are made when they are first needed.
    fn halves(&mut self, side: usize, at: u32) -> u32 {
        let pieces = &mut self.pieces[if self.is_same { 0 } else { side }];
        let piece = &pieces[at as usize];
        if piece.halves != NONE {
            return piece.halves;
        }
        let cuts = piece.cuts + 1;
        let halves = cut_in_half(&piece.outline).map(|outline| Piece::new(outline, cuts));
        let first = pieces.len() as u32;
        pieces.extend(halves);
        pieces[at as usize].halves = first;
        first
    }
}

/// The halves of a convex polygon on both sides of the plane that is midway between the corners farthest apart.
fn cut_in_half(outline: &[DVec3]) -> [Vec<DVec3>; 2] {
    let (mut middle, mut along) = (DVec3::ZERO, DVec3::ZERO);
    for (k, &a) in outline.iter().enumerate() {
        for &b in &outline[..k] {
            if (b - a).length_squared() > along.length_squared() {
                (middle, along) = (0.5 * (a + b), b - a);
            }
        }
    }
    [along, -along].map(|along| clip(outline, |corner| along.dot(corner - middle)))
}

/// The moments of a convex polygon.
fn of_outline(outline: &[DVec3]) -> Moments {
    let triangles = || outline.windows(2).skip(1).map(|side| [outline[0], side[0], side[1]]);
    let area_of = |[a, b, c]: [DVec3; 3]| 0.5 * (b - a).cross(c - a).length();
    let area: f64 = triangles().map(area_of).sum();
    if area <= 0.0 {
        let point = outline.first().copied().unwrap_or_default();
        return Moments { area: 0.0, point, covariance: Covariance::default(), size_squared: 0.0 };
    }
    let weighted = || triangles().map(|triangle| (area_of(triangle) / area, triangle));
    let point = weighted().map(|(weight, [a, b, c])| weight / 3.0 * (a + b + c)).sum();
    let mut covariance = Covariance::default();
    for (weight, triangle) in weighted() {
        let [a, b, c] = triangle.map(|corner| corner - point);
        let mean = Covariance::of([(1.0 / 12.0, a), (1.0 / 12.0, b), (1.0 / 12.0, c), (1.0 / 12.0, a + b + c)]);
        covariance = covariance.plus(&mean.times(weight));
    }
    let radius_squared = outline.iter().map(|corner| corner.distance_squared(point)).fold(0.0, f64::max);
    Moments { area, point, covariance, size_squared: size_squared(&covariance, radius_squared) }
}
