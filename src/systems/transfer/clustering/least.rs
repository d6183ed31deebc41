//! Squared errors of some points in f64. Points whose error for the same cluster is requested are computed together, so
//! that its vectors are read once for all of them.

use super::AffineSubspace;
use super::products::{MANY, PartialSums, dots_of_many};
use super::subspace::NO_ERROR;
use crate::linalg::dot;

/// Requested pairs of points and clusters, and scratch memory.
#[derive(Debug, Default)]
pub(super) struct ErrorRequests {
    /// A cluster and a point.
    wanted: Vec<(u32, u32)>,
    residuals: [Vec<f64>; MANY],
    sums: Vec<[PartialSums; MANY]>,
}

impl ErrorRequests {
    /// Asks for the error of a point in a cluster.
    #[inline(always)]
    pub(super) fn push(&mut self, cluster: u32, point: u32) {
        self.wanted.push((cluster, point));
    }

    /// Calls `into` with each cluster, each point and its error there, equal to [`AffineSubspace::squared_error`], by
    /// increasing cluster and point; returns their number, and clears the requests.
    #[inline(always)]
    pub(super) fn answer<'a>(
        &mut self,
        subspaces: &[&AffineSubspace],
        point: impl Fn(u32) -> &'a [f32],
        mut into: impl FnMut(u32, u32, f64),
    ) -> usize {
        let Self { wanted, residuals, sums } = self;
        wanted.sort_unstable();
        for of_cluster in wanted.chunk_by(|a, b| a.0 == b.0) {
            let subspace = subspaces[of_cluster[0].0 as usize];
            let mut many = of_cluster.chunks_exact(MANY);
            for some in &mut many {
                for (residual, &(_, at)) in residuals.iter_mut().zip(some) {
                    subspace.residual(point(at), residual);
                }
                let residuals = residuals.each_ref().map(Vec::as_slice);
                let distances = residuals.map(|residual| dot(residual, residual));
                let mut left = distances;
                dots_of_many(&subspace.vectors, residuals, sums, |along| {
                    left.iter_mut().zip(along).for_each(|(left, along)| *left -= along * along);
                });
                for ((&(cluster, at), left), distance) in some.iter().zip(left).zip(distances) {
                    into(cluster, at, if left <= distance * NO_ERROR { 0.0 } else { left });
                }
            }
            for &(cluster, at) in many.remainder() {
                into(cluster, at, subspace.squared_error(point(at), &mut residuals[0]));
            }
        }
        let count = wanted.len();
        wanted.clear();
        count
    }
}
