//! Optimal split of a small cluster, by exhaustive search.

use super::graph::FaceGraph;
use super::measures::{FaceMeasures, SplitLimits};

/// Maximum number of faces for exhaustive search.
pub(super) const MOST: usize = 8;

/// Weight of the halves' spread; the weight of their unevenness is 1. Both measures are in [0, 1].
const SPREAD: f64 = 0.25;

/// Splits a cluster of 2 to [`MOST`] faces: within the limits, into the fewest connected parts; among such splits, the
/// most even and compact one. `true` marks the second half.
pub(super) fn cut(graph: &FaceGraph, measures: &FaceMeasures, limits: SplitLimits) -> Vec<bool> {
    let count = graph.len();
    let linked: Vec<u32> =
        (0..count as u32).map(|face| graph.links(face).iter().fold(0, |mask, link| mask | 1 << link.to)).collect();
    let all = (1_u32 << count) - 1;
    let whole = moments(graph, measures, all);
    let mut best: Option<(u32, f64, u32)> = None;
    // The last face is always in the second half: the remaining cuts are the same with the halves exchanged.
    for first in 1..1_u32 << (count - 1) {
        let second = all & !first;
        if !limits.contains(&(first.count_ones() as usize)) {
            continue;
        }
        let parts = parts(&linked, first) + parts(&linked, second);
        if best.is_some_and(|(fewest, ..)| parts > fewest) {
            continue;
        }
        let halves = [first, second].map(|half| moments(graph, measures, half));
        let uneven = share((halves[0].0 - halves[1].0).abs(), whole.0);
        let cost = uneven + SPREAD * share(halves[0].1 + halves[1].1, whole.1);
        if best.is_none_or(|(fewest, least, _)| parts < fewest || cost < least) {
            best = Some((parts, cost, first));
        }
    }
    let first = best.map_or(1, |(.., first)| first);
    (0..count).map(|face| first >> face & 1 == 0).collect()
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

fn parts(linked: &[u32], set: u32) -> u32 {
    let (mut left, mut count) = (set, 0);
    while left != 0 {
        let mut reached = left & left.wrapping_neg();
        let mut new = reached;
        while new != 0 {
            let face = new.trailing_zeros();
            new &= new - 1;
            let more = linked[face as usize] & left & !reached;
            reached |= more;
            new |= more;
        }
        left &= !reached;
        count += 1;
    }
    count
}

/// Demand of a set of faces, and the sum of squared distances of the faces' centres from their mean.
fn moments(graph: &FaceGraph, measures: &FaceMeasures, set: u32) -> (f64, f64) {
    let faces = || (0..graph.len()).filter(|face| set >> face & 1 == 1).map(|face| graph.faces()[face]);
    let demand = faces().map(|face| measures.demands[face as usize]).sum();
    let mean = faces().map(|face| measures.centers[face as usize]).sum::<glam::DVec3>() / f64::from(set.count_ones());
    (demand, faces().map(|face| (measures.centers[face as usize] - mean).length_squared()).sum())
}
