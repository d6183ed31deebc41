//! A cluster cut in two.

use super::graph::FaceGraph;
use super::measures::FaceMeasures;
use super::{small, sweep};

/// Cuts a cluster of at least two faces into halves that get `capacity` texels each: `true` for the second half.
///
/// Neither half has more faces than texels. Both are connected where the cluster is, if such a cut is found; as far as
/// that leaves a choice, they demand the same number of texels.
pub(super) fn cut(graph: &FaceGraph, measures: &FaceMeasures, capacity: usize) -> Vec<bool> {
    let count = graph.len();
    let limits = count.saturating_sub(capacity).max(1)..=capacity.min(count - 1);
    if count <= small::MOST {
        return small::cut(graph, measures, limits);
    }
    let (part, parts) = graph.parts(|_| true);
    match parts {
        1 => sweep::cut_connected(graph, measures, limits),
        _ => sweep::cut_parts(graph, measures, limits, &part, parts),
    }
}
