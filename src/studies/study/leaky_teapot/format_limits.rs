//! What a number format loses: normals of triangles, and values of t.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::geom::Hit;
use crate::ray_engine::BitsLeft;
use crate::report::digits::count;

/// Minimum fraction of triangles with a lost normal for a warning.
const MUCH: f64 = 0.25;
/// Minimum number of hits for counting the values of t.
const SOME_HITS: u64 = 100;
/// Minimum number of hits per distinct value of t for a warning.
const HITS_PER_VALUE: u64 = 20;

/// What a card's number format loses in the scene and in the hits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct FormatLimits {
    /// Normals that are lost.
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
    pub(super) fn loses_normals(&self) -> bool {
        self.bits.share() >= MUCH
    }

    /// Returns `true` if many hits share a value of t. A float format is never coarse: there, few values of t mean a
    /// flat surface that faces the rays.
    pub(super) const fn is_coarse(&self) -> bool {
        self.bits.fixed_point && self.hits >= SOME_HITS && self.t_values * HITS_PER_VALUE <= self.hits
    }

    /// Clause about the normals that several rows lose.
    pub(super) fn lost_normals(rows: &[Self]) -> String {
        format!(
            "the format has too few bits for the normals of {} of {}, so rays miss these triangles or hit them at a \
             meaningless distance",
            range(rows.iter().map(|row| row.bits.below_step), ""),
            range(rows.iter().map(|row| row.bits.triangles), " triangles"),
        )
    }

    /// Clause about the few values of t in several rows.
    pub(super) fn coarse_distances(rows: &[Self]) -> String {
        format!(
            "the hit distance t has only {} for {}, so surfaces at nearly the same depth cannot be told apart",
            range(rows.iter().map(|row| row.t_values), " different values"),
            range(rows.iter().map(|row| row.hits), " hits"),
        )
    }

    /// Warning, if the format loses too many normals or has too few values of t.
    pub fn warning(&self) -> Option<String> {
        let normals = self.loses_normals().then(|| Self::lost_normals(&[*self]));
        let distances = self.is_coarse().then(|| Self::coarse_distances(&[*self]));
        let said: Vec<String> = normals.into_iter().chain(distances).collect();
        (!said.is_empty()).then(|| said.join("; "))
    }
}

/// The smallest and the largest of some numbers, with their noun: `2 to 5 hits`, or `2 hits` if they are equal.
fn range(numbers: impl Iterator<Item = u64> + Clone, noun: &str) -> String {
    let [least, most] = [numbers.clone().min(), numbers.max()].map(Option::unwrap_or_default);
    if least == most { format!("{}{noun}", count(least)) } else { format!("{} to {}{noun}", count(least), count(most)) }
}
