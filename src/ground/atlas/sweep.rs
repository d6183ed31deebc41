//! Splits of large clusters: the faces are ordered, and every prefix of the order is a candidate half.
//!
//! Given two faces far apart, A and B, faces are ordered by the difference of their distances from A and from B. A
//! face's predecessor on the shortest path from A precedes it in the order, and its predecessor on the shortest path
//! from B follows it, so both halves of any split are connected. The only exception is faces with equal differences in
//! a part that one face connects to the rest. Distances are integers, so rounding causes no other exception.

use glam::DVec3;

use super::graph::{FaceGraph, UNREACHED};
use super::measures::{FaceMeasures, SplitLimits};
use crate::elementary::on_circle;
use crate::geom::vector::{least_axis, unit};

/// Difference of two halves, as a fraction of the demand, that is accepted to keep a part of the mesh whole.
const WHOLE_PARTS: f64 = 1.0 / 32.0;

/// Difference, as a fraction of the demand, that is accepted for connected halves before other seeds are tried.
const MENDED: f64 = 1.0 / 16.0;

/// Number of flat cuts that are tried.
const DIRECTIONS: u32 = 6;

struct Halves {
    second: Vec<bool>,
    /// Difference of the halves' demands, as a fraction of their sum.
    uneven: f64,
}

/// Splits a connected cluster: by the shortest flat cut with connected halves, otherwise by shortest paths.
pub(super) fn cut_connected(graph: &FaceGraph, measures: &FaceMeasures, limits: SplitLimits) -> Vec<bool> {
    if let Some(flat) = cut_flat(graph, measures, &limits) {
        return flat;
    }
    let mut connected: Option<Halves> = None;
    let mut plain = None;
    for axis in axes(graph, measures) {
        let order = order(graph, measures, axis, |_| true);
        let halves = cut_order(graph, measures, &limits, &order);
        let (part, parts) = graph.parts(|face| halves.second[face as usize]);
        if parts == 2 {
            return halves.second;
        }
        if let Some(mended) = mend(graph, measures, &limits, &halves.second, &part, parts) {
            if mended.uneven <= MENDED {
                return mended.second;
            }
            if connected.as_ref().is_none_or(|best| mended.uneven < best.uneven) {
                connected = Some(mended);
            }
        }
        plain = plain.or(Some(halves));
    }
    connected.or(plain).map_or_else(|| vec![false; graph.len()], |halves| halves.second)
}

/// Finds the shortest of several flat cuts, in directions spread over the plane of the cluster's mean normal, that
/// leave both halves connected.
fn cut_flat(graph: &FaceGraph, measures: &FaceMeasures, limits: &SplitLimits) -> Option<Vec<bool>> {
    let mean: DVec3 = graph.faces().iter().map(|&face| measures.normals[face as usize]).sum();
    let [right, up] = plane(unit(mean).unwrap_or(DVec3::Z));
    let mut best: Option<(u64, Vec<bool>)> = None;
    for direction in 0..DIRECTIONS {
        // Half a turn: the opposite direction gives the same cuts with the halves exchanged.
        let [cos, sin] = on_circle(f64::from(direction) / f64::from(2 * DIRECTIONS));
        let along = right * cos + up * sin;
        let key = |face: u32| measures.centers[graph.faces()[face as usize] as usize].dot(along);
        let mut order: Vec<(f64, u32)> = (0..graph.len() as u32).map(|face| (key(face), face)).collect();
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let order: Vec<u32> = order.into_iter().map(|(_, face)| face).collect();
        let second = second_of(&order, best_cut(graph, measures, limits, &order));
        let length = graph.cut_length(&second);
        if best.as_ref().is_none_or(|(least, _)| length < *least) && graph.parts(|face| second[face as usize]).1 == 2 {
            best = Some((length, second));
        }
    }
    best.map(|(_, second)| second)
}

fn plane(normal: DVec3) -> [DVec3; 2] {
    let right = unit(least_axis(normal).cross(normal)).unwrap_or(DVec3::X);
    [right, normal.cross(right)]
}

/// Splits a cluster of several parts, along the longest axis: between two parts, or through the middle part.
pub(super) fn cut_parts(
    graph: &FaceGraph,
    measures: &FaceMeasures,
    limits: SplitLimits,
    part: &[u32],
    parts: u32,
) -> Vec<bool> {
    let [axis, ..] = axes(graph, measures);
    let place = part_places(graph, measures, axis, part, parts);
    let mut order: Vec<u32> = (0..graph.len() as u32).collect();
    order.sort_by_key(|&face| place[part[face as usize] as usize]);
    let at = best_cut(graph, measures, &limits, &order);
    let total = demand(graph, measures, &order);
    let starts: Vec<usize> =
        (1..order.len()).filter(|&k| part[order[k] as usize] != part[order[k - 1] as usize]).collect();
    let uneven = |k: usize| (total - 2.0 * demand(graph, measures, &order[..k])).abs();
    // The boundaries on both sides of the best cut.
    let behind = starts.partition_point(|&k| k < at);
    let near = [behind.checked_sub(1), Some(behind)].into_iter().flatten().filter_map(|index| starts.get(index));
    let between = near.copied().filter(|k| limits.contains(k)).min_by(|a, b| uneven(*a).total_cmp(&uneven(*b)));
    if let Some(k) = between.filter(|&k| k == at || uneven(k) <= WHOLE_PARTS * total) {
        return second_of(&order, k);
    }
    // The cut goes through a part, whose faces are ordered by a sweep.
    let cut = part[order[at] as usize];
    let from = order.partition_point(|&face| place[part[face as usize] as usize] < place[cut as usize]);
    let within = self::order(graph, measures, axis, |face| part[face as usize] == cut);
    order[from..from + within.len()].copy_from_slice(&within);
    cut_order(graph, measures, &limits, &order).second
}

/// Rank of each part along an axis, by the mean of its faces' centres.
fn part_places(graph: &FaceGraph, measures: &FaceMeasures, axis: usize, part: &[u32], parts: u32) -> Vec<u32> {
    let mut sums = vec![(0.0, 0.0); parts as usize];
    for (&of, &face) in part.iter().zip(graph.faces()) {
        let sum = &mut sums[of as usize];
        *sum = (sum.0 + measures.centers[face as usize][axis], sum.1 + 1.0);
    }
    let mut by_place: Vec<u32> = (0..parts).collect();
    let mean = |of: u32| sums[of as usize].0 / sums[of as usize].1;
    by_place.sort_by(|a, b| mean(*a).total_cmp(&mean(*b)));
    let mut place = vec![0; parts as usize];
    (0..).zip(by_place).for_each(|(at, of)| place[of as usize] = at);
    place
}

/// Axes, in descending order of the cluster's extent along them.
fn axes(graph: &FaceGraph, measures: &FaceMeasures) -> [usize; 3] {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &face in graph.faces() {
        low = low.min(measures.centers[face as usize]);
        high = high.max(measures.centers[face as usize]);
    }
    let extent = high - low;
    let mut axes = [0, 1, 2];
    axes.sort_by(|a, b| extent[*b].total_cmp(&extent[*a]));
    axes
}

/// Orders the faces of a connected part by a sweep: from its lowest face along an axis to the face farthest from it.
fn order(graph: &FaceGraph, measures: &FaceMeasures, axis: usize, of: impl Fn(u32) -> bool) -> Vec<u32> {
    let mut order: Vec<u32> = (0..graph.len() as u32).filter(|&face| of(face)).collect();
    let along = |face: u32| measures.centers[graph.faces()[face as usize] as usize][axis];
    let Some(low) = order.iter().copied().reduce(|a, b| if along(b) < along(a) { b } else { a }) else {
        return order;
    };
    let from_low = graph.distances(low);
    let distance = |face: u32| from_low[face as usize];
    let reached = order.iter().copied().filter(|&face| distance(face) != UNREACHED);
    let high = reached.reduce(|a, b| if distance(b) > distance(a) { b } else { a }).unwrap_or(low);
    let from_high = graph.distances(high);
    order.sort_unstable_by_key(|&face| {
        let [from, to] = [from_low[face as usize], from_high[face as usize]];
        (i128::from(from) - i128::from(to), from, face)
    });
    order
}

fn demand(graph: &FaceGraph, measures: &FaceMeasures, faces: &[u32]) -> f64 {
    faces.iter().map(|&face| measures.demands[graph.faces()[face as usize] as usize]).sum()
}

/// The number of faces of the first half, within the limits, that makes the halves' demands most equal.
fn best_cut(graph: &FaceGraph, measures: &FaceMeasures, limits: &SplitLimits, order: &[u32]) -> usize {
    let half = demand(graph, measures, order) / 2.0;
    let mut best = (f64::INFINITY, *limits.start());
    let mut sum = 0.0;
    for (k, &face) in (1..).zip(order) {
        sum += measures.demands[graph.faces()[face as usize] as usize];
        if limits.contains(&k) && (sum - half).abs() < best.0 {
            best = ((sum - half).abs(), k);
        }
    }
    best.1
}

fn cut_order(graph: &FaceGraph, measures: &FaceMeasures, limits: &SplitLimits, order: &[u32]) -> Halves {
    let at = best_cut(graph, measures, limits, order);
    let total = demand(graph, measures, order);
    let uneven = (total - 2.0 * demand(graph, measures, &order[..at])).abs() / total;
    Halves { second: second_of(order, at), uneven }
}

fn second_of(order: &[u32], at: usize) -> Vec<bool> {
    let mut second = vec![false; order.len()];
    order[at..].iter().for_each(|&face| second[face as usize] = true);
    second
}

/// Makes halves of several parts connected: in each half, the part with the largest demand stays, and the other parts
/// move to the other half. `None` if the result violates the limits or is not connected.
fn mend(
    graph: &FaceGraph,
    measures: &FaceMeasures,
    limits: &SplitLimits,
    second: &[bool],
    part: &[u32],
    parts: u32,
) -> Option<Halves> {
    let mut demands = vec![0.0; parts as usize];
    part.iter().zip(graph.faces()).for_each(|(&of, &face)| demands[of as usize] += measures.demands[face as usize]);
    let mut largest: [Option<u32>; 2] = [None; 2];
    for (&of, &side) in part.iter().zip(second) {
        let best = &mut largest[usize::from(side)];
        if best.is_none_or(|best| demands[of as usize] > demands[best as usize]) {
            *best = Some(of);
        }
    }
    let stays = |of: u32, side: bool| largest[usize::from(side)] == Some(of);
    let mended: Vec<bool> =
        part.iter().zip(second).map(|(&of, &side)| if stays(of, side) { side } else { !side }).collect();
    let firsts = mended.iter().filter(|side| !**side).count();
    if !limits.contains(&firsts) || graph.parts(|face| mended[face as usize]).1 != 2 {
        return None;
    }
    let of_side = |own: bool| {
        let faces = graph.faces().iter().zip(&mended).filter(|(_, side)| **side == own);
        faces.map(|(&face, _)| measures.demands[face as usize]).sum::<f64>()
    };
    let [first, last] = [of_side(false), of_side(true)];
    Some(Halves { second: mended, uneven: (first - last).abs() / (first + last) })
}
