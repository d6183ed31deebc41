//! Census of the light's segments that vertices see, for the fraction omega of Table 1.

use glam::DVec3;
use rayon::prelude::*;

use super::maps::VisibilityMaps;
use crate::transfer::Vertices;
use crate::transfer::grid::{FineDirections, Segmentation};
use crate::transfer::linear_basis::LinearBasis;

/// Counts of the 24 segments of the light over all vertices: below the horizon, shadowed, or with transfer. Each
/// segment of a vertex is counted in exactly one of the three.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SegmentCensus {
    /// Number of segments: vertices times 24.
    pub segments: u64,
    /// Segments whose fine directions all lie below the horizon of the vertex's normal.
    pub below_horizon: u64,
    /// Segments whose fine directions above the horizon are all shadowed.
    pub shadowed: u64,
    /// Segments with transfer: all others.
    pub nonempty: u64,
    /// The lowest number of segments below the horizon at a vertex.
    pub least_below: u32,
}

impl SegmentCensus {
    /// Counts over all vertices of some maps. A fine direction belongs to a segment if a hat function of the segment's
    /// texels is not 0 there; with a width of one texel, if the direction is in the segment. Panics if the maps belong
    /// to other vertices.
    pub fn new(vertices: &Vertices, maps: &VisibilityMaps, hats: &LinearBasis) -> Self {
        let of_map = |map: usize| {
            let normal = vertices.frames()[maps.vertices()[map] as usize].normal();
            let below = segments_below_horizon(normal, hats);
            let seen = (0..24).filter(|&segment| hats.segment(segment).sees(maps.bits(map))).count() as u64;
            (below, seen)
        };
        let counted: Vec<(u32, u64)> = (0..maps.len()).into_par_iter().map(of_map).collect();
        let mut census = Self { segments: 24 * maps.len() as u64, least_below: 24, ..Self::default() };
        for (below, seen) in counted {
            let below = below.count_ones();
            census.below_horizon += u64::from(below);
            census.nonempty += seen;
            census.least_below = census.least_below.min(below);
        }
        census.shadowed = census.segments - census.below_horizon - census.nonempty;
        census
    }

    /// The fraction omega of segments with transfer.
    pub fn omega(&self) -> f64 {
        self.nonempty as f64 / self.segments.max(1) as f64
    }

    /// Mean number of segments below the horizon per vertex.
    pub fn mean_below(&self) -> f64 {
        24.0 * self.below_horizon as f64 / self.segments.max(1) as f64
    }
}

/// The segments without a fine direction above the horizon of a unit normal, one bit per segment from the lowest bit
/// up.
pub fn segments_below_horizon(normal: DVec3, hats: &LinearBasis) -> u32 {
    let directions = FineDirections::get().directions();
    let is_above = |fine: usize| normal.dot(directions[fine]) > 0.0;
    (0..Segmentation::Quarters.count())
        .fold(0, |found, segment| found | u32::from(!hats.rim(segment).any(is_above)) << segment)
}
