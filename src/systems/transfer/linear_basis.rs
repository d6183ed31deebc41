//! The hat functions of equation 10: the weight of each light texel in each fine direction.
//!
//! With a width of two texels the hat function of a texel is bilinear on its face: 1 at its center, 0 at the centers of
//! its neighbors. In a fine direction at distances a and b (0 to 1/2 texel) from the center of the texel that contains
//! it, four texels have the weights (1 - a)(1 - b), a (1 - b), (1 - a) b and a b.
//!
//! - *Across an edge of the cube* the neighbor is the adjacent texel of the next face; along an edge, the texels of
//!   both faces meet one to one.
//! - *At the eight corners* only three texels meet. The weight a b of the missing fourth is divided equally among the
//!   three, as in the filtering of seamless cube maps (`GL_ARB_seamless_cube_map`): hat functions are continuous over
//!   all three edges and have the symmetry of the cube.
//!
//! For every fine direction the weights sum to 1 (up to the rounding of thirds): light with radiance 1 in every texel
//! is 1 in every direction. The hat functions interpolate the texels' light.
//!
//! `DIFFERENCE`: the paper's hat is "centered at the sample" over "the cone of directions within one cube map texel";
//! edges, corners and solid angles are not mentioned. As a bilinear hat it extends one texel from its center, so it is
//! two texels wide. A hat one texel wide can only sum to 1 if it is a box.

use serde::{Deserialize, Serialize};

use super::grid::{
    FINE_DIRECTIONS, FINE_SIDE, FineDirections, LIGHT_SIDE, SUPERSAMPLES, Segmentation, face_row_column,
};
use crate::sphere::CUBE_FACES;

/// The width of the hat function of a light texel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, strum::Display)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum BasisWidth {
    /// The texel alone: a box.
    OneTexel,
    /// Bilinear, to the centers of the neighbors.
    #[default]
    TwoTexels,
}

/// Largest number of texels with a weight in one fine direction.
const SHARED: usize = 4;

/// The light texels with a weight in a fine direction, the texel that contains it first, and the weights.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BasisWeights {
    texels: [u32; SHARED],
    weights: [f64; SHARED],
    count: usize,
}

impl BasisWeights {
    /// The weights of a fine direction, given by its index. Panics if there is no such direction.
    pub fn of(width: BasisWidth, fine: usize) -> Self {
        assert!(fine < FINE_DIRECTIONS, "a fine direction, not {fine}");
        let [face, row, column] = face_row_column(fine, FINE_SIDE);
        let own = [row / SUPERSAMPLES, column / SUPERSAMPLES].map(usize::cast_signed);
        let mut found = Self::default();
        if width == BasisWidth::OneTexel {
            found.add(texel(face, own), 1.0);
            return found;
        }
        let (towards_row, b) = offset(row % SUPERSAMPLES);
        let (towards_column, a) = offset(column % SUPERSAMPLES);
        let beside = texel(face, [own[0], own[1] + towards_column]);
        let below = texel(face, [own[0] + towards_row, own[1]]);
        let across = texel(face, [own[0] + towards_row, own[1] + towards_column]);
        // A corner of the cube has no fourth texel: each of the other three gets a third of its weight.
        let third = if across.is_none() { a * b / 3.0 } else { 0.0 };
        found.add(texel(face, own), (1.0 - a) * (1.0 - b) + third);
        found.add(beside, a * (1.0 - b) + third);
        found.add(below, (1.0 - a) * b + third);
        found.add(across, a * b);
        found
    }

    fn add(&mut self, texel: Option<usize>, weight: f64) {
        if let Some(texel) = texel {
            (self.texels[self.count], self.weights[self.count]) = (texel as u32, weight);
            self.count += 1;
        }
    }

    /// Texels and weights. No texel occurs twice.
    pub fn iter(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.texels[..self.count].iter().map(|&texel| texel as usize).zip(self.weights[..self.count].iter().copied())
    }
}

/// The neighbor to which a fine row or column of a texel is nearer (-1 or 1), and its distance from the texel's center
/// in texels.
fn offset(fine: usize) -> (isize, f64) {
    let from_center = (2 * fine + 1) as f64 / (2 * SUPERSAMPLES) as f64 - 0.5;
    (if from_center < 0.0 { -1 } else { 1 }, from_center.abs())
}

/// The texel at a row and column of a face. One texel beyond the border, it is the adjacent texel of the neighboring
/// face; `None` beyond a corner.
fn texel(face: usize, [row, column]: [isize; 2]) -> Option<usize> {
    let side = LIGHT_SIDE.cast_signed();
    let is_inside = |at: isize| (0..side).contains(&at);
    if is_inside(row) && is_inside(column) {
        return Some((face * LIGHT_SIDE + row.cast_unsigned()) * LIGHT_SIDE + column.cast_unsigned());
    }
    if !is_inside(row) && !is_inside(column) {
        return None;
    }
    // Coordinates are in half texels from the cube's center, with faces at `side`: integers, exact in f64. The strip of
    // texels beyond an edge is folded over it by a quarter turn.
    let axes = CUBE_FACES[face];
    let half_texels = |at: isize| (2 * at + 1 - side) as f64;
    let [down, right] = [half_texels(row), half_texels(column)];
    let reach = side as f64;
    let beyond = (down.abs().max(right.abs()) - reach).max(0.0);
    let folded = axes.center * (reach - beyond)
        + axes.right * right.clamp(-reach, reach)
        + axes.down * down.clamp(-reach, reach);
    let next = CUBE_FACES.iter().position(|other| *other != axes && other.center.dot(folded) == reach)?;
    let place = |along: f64| ((along + reach - 1.0) / 2.0) as usize;
    let [row, column] = [CUBE_FACES[next].down, CUBE_FACES[next].right].map(|axis| place(axis.dot(folded)));
    Some((next * LIGHT_SIDE + row) * LIGHT_SIDE + column)
}

/// A fine direction's contribution to one segment of the light.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SegmentSample {
    /// The fine direction.
    pub(crate) fine: u32,
    /// Texels within the segment, and their hat functions' values times the solid angle. Unused entries are 0.
    pub(crate) places: [u16; SHARED],
    pub(crate) weights: [f64; SHARED],
    pub(crate) count: u8,
}

/// The hat functions of one segment's texels, as the fine directions in which any of them is not 0, in order.
#[derive(Clone, Debug)]
pub(crate) struct SegmentBasis {
    pub(crate) samples: Vec<SegmentSample>,
    /// The words of visibility bits with samples: index of the word, mask of its samples, and index of the word's first
    /// sample.
    pub(crate) words: Vec<(u32, u64, u32)>,
    /// See [`LinearBasis::rim`].
    rim: Vec<u32>,
}

/// The hat functions of all segments.
#[derive(Clone, Debug)]
pub struct LinearBasis {
    width: BasisWidth,
    segments: Vec<SegmentBasis>,
}

impl LinearBasis {
    /// The hat functions of all light texels, for 24 segments.
    pub fn new(width: BasisWidth) -> Self {
        let segmentation = Segmentation::Quarters;
        let mut samples: Vec<Vec<SegmentSample>> = vec![Vec::new(); segmentation.count()];
        for (fine, &solid_angle) in FineDirections::get().solid_angles().iter().enumerate() {
            for (texel, weight) in BasisWeights::of(width, fine).iter() {
                let [segment, place] = segmentation.place(texel);
                let of_segment = &mut samples[segment];
                if of_segment.last().is_none_or(|last| last.fine as usize != fine) {
                    of_segment.push(SegmentSample { fine: fine as u32, ..SegmentSample::default() });
                }
                let Some(sample) = of_segment.last_mut() else { continue };
                let at = usize::from(sample.count);
                (sample.places[at], sample.weights[at]) = (place as u16, weight * solid_angle);
                sample.count += 1;
            }
        }
        Self { width, segments: samples.into_iter().map(SegmentBasis::new).collect() }
    }

    /// The width of the hat functions.
    pub const fn width(&self) -> BasisWidth {
        self.width
    }

    /// The fine directions in which a hat function of the segment is not 0, in order. Panics if there is no such
    /// segment.
    pub fn directions(&self, segment: usize) -> impl Iterator<Item = usize> + '_ {
        self.segments[segment].samples.iter().map(|sample| sample.fine as usize)
    }

    /// Fine directions that enclose all others of a segment: if they are below a horizon, so are all others. On each
    /// face they are the corners of a rectangle.
    pub(crate) fn rim(&self, segment: usize) -> impl Iterator<Item = usize> + '_ {
        self.segments[segment].rim.iter().map(|&fine| fine as usize)
    }

    pub(crate) fn segment(&self, segment: usize) -> &SegmentBasis {
        &self.segments[segment]
    }
}

impl SegmentBasis {
    fn new(samples: Vec<SegmentSample>) -> Self {
        let mut words: Vec<(u32, u64, u32)> = Vec::new();
        for (at, sample) in samples.iter().enumerate() {
            let word = sample.fine / 64;
            if words.last().is_none_or(|last| last.0 != word) {
                words.push((word, 0, at as u32));
            }
            if let Some(last) = words.last_mut() {
                last.1 |= 1 << (sample.fine % 64);
            }
        }
        let rim = rim(&samples);
        Self { samples, words, rim }
    }

    /// True if any fine direction of the segment is set in these visibility bits.
    pub(crate) fn sees(&self, bits: &[u64]) -> bool {
        self.words.iter().any(|&(word, mask, _)| bits[word as usize] & mask != 0)
    }

    /// Visits the samples whose visibility bits are set, in order.
    #[inline(always)]
    pub(crate) fn for_each_seen(&self, bits: &[u64], mut visit: impl FnMut(&SegmentSample)) {
        for &(word, mask, first) in &self.words {
            let mut left = bits[word as usize] & mask;
            while left != 0 {
                let lowest = left.trailing_zeros();
                left &= left - 1;
                let before = (mask & ((1 << lowest) - 1)).count_ones();
                visit(&self.samples[(first + before) as usize]);
            }
        }
    }
}

/// The first and last samples of the first and last rows on each face.
fn rim(samples: &[SegmentSample]) -> Vec<u32> {
    let place = |sample: &SegmentSample| face_row_column(sample.fine as usize, FINE_SIDE);
    let mut found = Vec::new();
    for of_face in samples.chunk_by(|a, b| place(a)[0] == place(b)[0]) {
        let rows: Vec<_> = of_face.chunk_by(|a, b| place(a)[1] == place(b)[1]).collect();
        for row in [rows.first(), rows.last()].into_iter().flatten() {
            found.extend([row.first(), row.last()].into_iter().flatten().map(|sample| sample.fine));
        }
    }
    found
}
