//! Loss of information to the number format: in the triangles, and in t.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::geom::Hit;
use crate::ray_engine::BitsLeft;
use crate::report::digits::count;
use crate::report::words::{counted, percent};

/// Minimum fraction of triangles without a normal for a warning.
const MUCH: f64 = 0.25;
/// Minimum number of hits for counting the values of t.
const SOME_HITS: u64 = 100;
/// Minimum number of hits per distinct value of t for a warning.
const HITS_PER_VALUE: u64 = 20;

/// Loss of information to a card's number format, in the scene and in the hits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct FormatLimits {
    /// Loss in the triangles.
    #[serde(flatten)]
    pub bits: BitsLeft,
    /// Number of hits reported.
    pub hits: u64,
    /// Number of distinct values of t of these hits.
    pub t_values: u64,
}

impl FormatLimits {
    /// Measures triangles and hits.
    pub fn new(bits: BitsLeft, hits: &[Option<Hit>]) -> Self {
        let t: BTreeSet<u32> = hits.iter().flatten().map(|hit| hit.t.to_bits()).collect();
        Self { bits, hits: hits.iter().flatten().count() as u64, t_values: t.len() as u64 }
    }

    /// Returns `true` if many triangles have a normal below one step of the format.
    pub fn triangles_vanish(&self) -> bool {
        self.bits.share() >= MUCH
    }

    /// Returns `true` if many hits share a value of t. In a float format, few values mean a flat surface that faces the
    /// rays.
    pub fn t_is_coarse(&self) -> bool {
        self.bits.fixed_point && self.hits >= SOME_HITS && self.t_values * HITS_PER_VALUE <= self.hits
    }

    /// Warning, if the format loses too much.
    pub fn warning(&self) -> Option<String> {
        let below = format!(
            "n of {} of {} ({}) is below one step of the card's format",
            count(self.bits.below_step),
            counted(self.bits.triangles, "triangle", "triangles"),
            percent(self.bits.share()),
        );
        let values = format!(
            "t of {} has {}",
            counted(self.hits, "hit", "hits"),
            counted(self.t_values, "value", "different values")
        );
        let said = match (self.triangles_vanish(), self.t_is_coarse()) {
            (true, true) => format!("{below}, and {values}"),
            (true, false) => below,
            (false, true) => values,
            (false, false) => return None,
        };
        Some(format!("no bits left: {said}"))
    }
}
