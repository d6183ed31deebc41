//! Finds the cluster that approximates each point best (on ties, the lowest), by comparing every point with every
//! cluster in f64. Signals of many dimensions are first compared along their principal axes ([`Axes`]): a cluster whose
//! lower bound exceeds an error already found is skipped, which changes only the time.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::axes::{AlongAxes, Axes};
use super::{AffineSubspace, Signal};

/// Points per block; a cluster's vectors are read once per block.
const BLOCK: usize = 64;

/// The best cluster of each point, and the squared error of its approximation there.
pub(super) fn nearest(
    signal: &Signal,
    axes: Option<&Axes>,
    subspaces: &[&AffineSubspace],
    level: SimdLevel,
) -> (Vec<u32>, Vec<f64>) {
    let along = |axes: &Axes| subspaces.par_iter().map(|subspace| axes.along(subspace, level)).collect::<Vec<_>>();
    let bounds = axes.map(|axes| (axes, along(axes)));
    let mut best = vec![(0, f64::INFINITY); signal.points()];
    best.par_chunks_mut(BLOCK).enumerate().for_each_init(Vec::new, |residual, (block, best)| {
        level.run(
            #[inline(always)]
            || match &bounds {
                Some((axes, along)) => search_by_bounds(signal, axes, subspaces, along, block * BLOCK, best, residual),
                None => search(signal, subspaces, block * BLOCK, best, residual),
            },
        );
    });
    best.into_iter().unzip()
}

/// Compares the points from `first` on with every cluster.
#[inline(always)]
fn search(
    signal: &Signal,
    subspaces: &[&AffineSubspace],
    first: usize,
    best: &mut [(u32, f64)],
    residual: &mut Vec<f64>,
) {
    for (cluster, subspace) in (0..).zip(subspaces) {
        for (point, best) in (first..).zip(&mut *best) {
            let error = subspace.squared_error(signal.point(point), residual);
            if error < best.1 {
                *best = (cluster, error);
            }
        }
    }
}

/// Compares the points from `first` on with the clusters that bounds do not exclude, beginning with the lowest bound.
#[inline(always)]
fn search_by_bounds(
    signal: &Signal,
    axes: &Axes,
    subspaces: &[&AffineSubspace],
    along: &[AlongAxes],
    first: usize,
    best: &mut [(u32, f64)],
    residual: &mut Vec<f64>,
) {
    let mut bounds = vec![[0.0; BLOCK]; along.len()];
    for (bounds, along) in bounds.iter_mut().zip(along) {
        for (point, bound) in (first..).zip(&mut bounds[..best.len()]) {
            *bound = axes.bound(along, point, residual);
        }
    }
    for (at, best) in best.iter_mut().enumerate() {
        let point = signal.point(first + at);
        let lowest = (0..bounds.len()).fold(0, |low, k| if bounds[k][at] < bounds[low][at] { k } else { low });
        *best = (lowest as u32, subspaces[lowest].squared_error(point, residual));
        for (cluster, bounds) in bounds.iter().enumerate().filter(|&(cluster, _)| cluster != lowest) {
            if bounds[at] > best.1 {
                continue;
            }
            let error = subspaces[cluster].squared_error(point, residual);
            if error < best.1 || (error == best.1 && (cluster as u32) < best.0) {
                *best = (cluster as u32, error);
            }
        }
    }
}
