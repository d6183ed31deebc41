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

    /// Warning, if the format loses too much: if many triangles have a normal below one step of the format, or many
    /// hits share a value of t. In a float format, few values mean a flat surface that faces the rays.
    pub fn warning(&self) -> Option<String> {
        let Self { bits, hits, t_values } = *self;
        let is_coarse = bits.fixed_point && hits >= SOME_HITS && t_values * HITS_PER_VALUE <= hits;
        let below = (bits.share() >= MUCH).then(|| {
            format!(
                "n of {} of {} ({}) is below one step of the card's format",
                count(bits.below_step),
                counted(bits.triangles, "triangle", "triangles"),
                percent(bits.share()),
            )
        });
        let values = is_coarse.then(|| {
            let values = counted(t_values, "value", "different values");
            format!("t of {} has {values}", counted(hits, "hit", "hits"))
        });
        let said: Vec<String> = below.into_iter().chain(values).collect();
        (!said.is_empty()).then(|| format!("no bits left: {}", said.join(", and ")))
    }
}
