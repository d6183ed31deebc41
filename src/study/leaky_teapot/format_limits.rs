//! Where a kernel has no bits left: what the number format keeps of the triangles, and of t.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::geom::Hit;
use crate::ray_engine::BitsLeft;
use crate::report::digits::count;
use crate::report::words::{counted, percent};

/// The share of triangles without a normal from which on it is worth a warning.
const MUCH: f64 = 0.25;
/// Hits from which on the values of t are counted.
const SOME_HITS: u64 = 100;
/// Hits per value of t from which on it is worth a warning.
const HITS_PER_VALUE: u64 = 20;

/// What the format of a card leaves of a scene and of the answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct FormatLimits {
    /// Of the triangles.
    #[serde(flatten)]
    pub bits: BitsLeft,
    /// Hits reported.
    pub hits: u64,
    /// Different values of t among them.
    pub t_values: u64,
}

impl FormatLimits {
    /// Of triangles and hits.
    pub fn new(bits: BitsLeft, hits: &[Option<Hit>]) -> Self {
        let t: BTreeSet<u32> = hits.iter().flatten().map(|hit| hit.t.to_bits()).collect();
        Self { bits, hits: hits.iter().flatten().count() as u64, t_values: t.len() as u64 }
    }

    /// What to say where next to nothing is left.
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
        // In a float format few values mean that the surface is flat and faces the rays.
        let few = self.bits.fixed_point && self.hits >= SOME_HITS && self.t_values * HITS_PER_VALUE <= self.hits;
        let said = match (self.bits.share() >= MUCH, few) {
            (true, true) => format!("{below}, and {values}"),
            (true, false) => below,
            (false, true) => values,
            (false, false) => return None,
        };
        Some(format!("no bits left: {said}"))
    }
}
