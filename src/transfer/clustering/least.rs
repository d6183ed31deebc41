//! The best clusters of some points in f64, among those that lower bounds leave. Points that ask for the same cluster
//! are taken together, so that its vectors are read once for all of them.

use super::AffineSubspace;
use super::estimate::{LANES, LowerBounds};
use super::products::{MANY, PartialSums, dots_of_many};
use super::subspace::NO_ERROR;
use crate::linalg::dot;

/// Room for a block of points.
#[derive(Debug, Default)]
pub(super) struct LeastScratch {
    /// A cluster and a point of the block, by cluster.
    wanted: Vec<(u32, u32)>,
    /// Of each of them.
    errors: Vec<f64>,
    residuals: [Vec<f64>; MANY],
    sums: Vec<[PartialSums; MANY]>,
}

/// The cluster of least error of each point, the lower of equals, and its error. `bounds` has lower bounds of all
/// errors, scaled: times `scale` squared.
#[inline(always)]
pub(super) fn least(
    points: &[&[f32]],
    subspaces: &[&AffineSubspace],
    (bounds, scale): (&[LowerBounds], f64),
    scratch: &mut LeastScratch,
    found: &mut [(u32, f64)],
) {
    scratch.wanted.clear();
    for (at, found) in found.iter_mut().enumerate() {
        found.0 = bounds[at / LANES].least(at % LANES);
        scratch.wanted.push((found.0, at as u32));
    }
    scratch.wanted.sort_unstable();
    scratch.evaluate(points, subspaces);
    for (&(_, at), &error) in scratch.wanted.iter().zip(&scratch.errors) {
        found[at as usize].1 = error;
    }
    scratch.wanted.clear();
    for cluster in 0..subspaces.len() as u32 {
        for (at, &(first, error)) in found.iter().enumerate() {
            let lower = bounds[at / LANES].of_cluster(cluster)[at % LANES];
            if cluster != first && f64::from(lower) <= error * scale * scale {
                scratch.wanted.push((cluster, at as u32));
            }
        }
    }
    scratch.evaluate(points, subspaces);
    for (&(cluster, at), &error) in scratch.wanted.iter().zip(&scratch.errors) {
        let best = &mut found[at as usize];
        if error < best.1 || (error == best.1 && cluster < best.0) {
            *best = (cluster, error);
        }
    }
}

impl LeastScratch {
    /// The errors of all that is wanted, as [`AffineSubspace::squared_error`] has them.
    #[inline(always)]
    fn evaluate(&mut self, points: &[&[f32]], subspaces: &[&AffineSubspace]) {
        self.errors.clear();
        let Self { wanted, errors, residuals, sums } = self;
        for of_cluster in wanted.chunk_by(|a, b| a.0 == b.0) {
            let subspace = subspaces[of_cluster[0].0 as usize];
            let mut many = of_cluster.chunks_exact(MANY);
            for some in &mut many {
                for (residual, &(_, at)) in residuals.iter_mut().zip(some) {
                    subspace.residual(points[at as usize], residual);
                }
                let residuals = residuals.each_ref().map(Vec::as_slice);
                let distances = residuals.map(|residual| dot(residual, residual));
                let mut left = distances;
                dots_of_many(&subspace.vectors, residuals, sums, |along| {
                    left.iter_mut().zip(along).for_each(|(left, along)| *left -= along * along);
                });
                let zero = |(left, distance): (f64, f64)| if left <= distance * NO_ERROR { 0.0 } else { left };
                errors.extend(left.into_iter().zip(distances).map(zero));
            }
            for &(_, at) in many.remainder() {
                errors.push(subspace.squared_error(points[at as usize], &mut residuals[0]));
            }
        }
    }
}
