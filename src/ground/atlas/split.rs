//! Split of a cluster in two.

use super::graph::FaceGraph;
use super::measures::FaceMeasures;
use super::{small, sweep};

/// Splits a cluster of at least two faces into halves with `capacity` texels each: `true` marks the second half.
///
/// Neither half has more faces than texels. Both are connected where the cluster is, if such a split is found; within
/// that constraint, their demands are as equal as possible.
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
