//! Estimates in f32 of the squared error that each cluster leaves at each point, with bounds of how far they are off.
//!
//! Points and subspaces are taken relative to a center g and scaled by a power of two, so that no point is longer
//! than 1. With X = |x - g|, M = |x_0 - g|, S = X + M, D = |x - x_0| and n' vectors, an inner product of n
//! terms in f32, summed in chunks, is off by at most e times the lengths of its vectors,
//! `e = (CHUNK + n / CHUNK + 8) 2^-24`. A weight is then off by at most e S, a sum of n' squared weights by
//! `2 sqrt(n') D e S + n' (e S)^2` because it is at most D^2, and D^2 by e S^2. [`bound`] is their sum with the
//! rounding of the additions. [`REST`] `(1 + M)^2` stands for what f64 rounds in the errors that are decided by.

use super::products::{Packed, ROWS, add_block};
use crate::linalg::dot;

/// Points that are estimated side by side.
pub(super) const LANES: usize = 16;
/// Terms of an inner product that are summed in f32 before they join the rest.
const CHUNK: usize = 32;
/// The rounding of an operation in f32.
const UNIT: f32 = 1.0 / (1 << 24) as f32;
/// More than f64 rounds in a squared error, as a share of the squared distance from the mean: some
/// `2 sqrt(n') (n / 8 + 4) 2^-53`, and what counts as no error.
const REST: f32 = 1.0 / (1 << 30) as f32;
/// Added to each bound, against products too small for f32; lengths are at most 1.
const SMALL: f32 = 1e-30;

type Lanes = [f32; LANES];

/// A row of the estimates: which vector of which cluster.
#[derive(Clone, Copy, Debug)]
enum RowKind {
    /// The cluster's mean, with its squared length.
    Mean(f32),
    /// One of its vectors, with the mean's weight on it.
    Vector(f32),
}

/// A subspace relative to g and scaled, perhaps projected onto fewer dimensions.
#[derive(Clone, Debug)]
pub(super) struct ScaledSubspace {
    /// M, before the projection.
    pub(super) length: f64,
    /// The mean, as many numbers as points have; empty if it is 0.
    pub(super) offset: Vec<f64>,
    /// Orthonormal vectors, one after another.
    pub(super) vectors: Vec<f64>,
}

/// Subspaces in f32.
#[derive(Debug)]
pub(super) struct Estimator {
    rows: Packed<f32, ROWS>,
    kinds: Vec<(usize, RowKind)>,
    bounds: Vec<ClusterBound>,
    error: f32,
}

/// What the bounds of a cluster depend on.
#[derive(Clone, Copy, Debug)]
struct ClusterBound {
    /// M.
    mean: f32,
    /// n' and its root.
    vectors: (f32, f32),
    /// What does not depend on the point.
    rest: f32,
}

/// Lower bounds of squared errors for a group of points, cluster by cluster.
#[derive(Clone, Debug)]
pub(super) struct LowerBounds {
    errors: Vec<Lanes>,
    distances: Vec<Lanes>,
    squares: Lanes,
}

impl Estimator {
    /// Of subspaces of `dimension` numbers.
    pub(super) fn new(dimension: usize, subspaces: &[ScaledSubspace]) -> Self {
        let (mut kinds, mut bounds, mut rows) = (Vec::new(), Vec::new(), Vec::new());
        for (cluster, ScaledSubspace { length, offset, vectors }) in subspaces.iter().enumerate() {
            if !offset.is_empty() {
                kinds.push((cluster, RowKind::Mean(dot(offset, offset) as f32)));
                rows.push(&offset[..]);
            }
            for vector in vectors.chunks_exact(dimension) {
                kinds.push((cluster, RowKind::Vector(dot(vector, offset) as f32)));
                rows.push(vector);
            }
            let (mean, vectors) = (*length as f32, (vectors.len() / dimension) as f32);
            let rest = SMALL + REST * (1.0 + mean) * (1.0 + mean);
            bounds.push(ClusterBound { mean, vectors: (vectors, vectors.sqrt()), rest });
        }
        let rows = Packed::new(rows.len(), dimension, |at, into: &mut [f32]| {
            into.iter_mut().zip(rows[at]).for_each(|(into, &value)| *into = value as f32);
        });
        Self { rows, kinds, bounds, error: (CHUNK + dimension / CHUNK + 8) as f32 * UNIT }
    }

    /// Bounds for groups of points: no error is below its bound.
    #[inline(always)]
    pub(super) fn estimate(&self, points: &Packed<f32, LANES>, groups: &mut [LowerBounds]) {
        for (group, points) in groups.iter_mut().zip(points.groups()) {
            group.square(points);
        }
        for (tile, rows) in self.rows.groups().enumerate() {
            let kinds = &self.kinds[tile * ROWS..];
            for (group, points) in groups.iter_mut().zip(points.groups()) {
                let mut sums = [[0.0; LANES]; ROWS];
                for (rows, points) in rows.chunks(CHUNK).zip(points.chunks(CHUNK)) {
                    add_block(rows, points, &mut sums);
                }
                for (&(cluster, kind), sums) in kinds.iter().zip(&sums) {
                    group.fold(cluster, kind, sums);
                }
            }
        }
        for group in groups {
            group.subtract_bounds(self);
        }
    }
}

impl LowerBounds {
    pub(super) fn new(clusters: usize) -> Self {
        let empty = vec![[0.0; LANES]; clusters];
        Self { errors: empty.clone(), distances: empty, squares: [0.0; LANES] }
    }

    /// The bounds of a lane, cluster by cluster.
    #[cfg(test)]
    pub(super) fn of(&self, lane: usize) -> impl Iterator<Item = f32> {
        self.errors.iter().map(move |errors| errors[lane])
    }

    /// The bounds of a cluster, lane by lane.
    #[inline(always)]
    pub(super) fn of_cluster(&self, cluster: u32) -> &[f32; LANES] {
        &self.errors[cluster as usize]
    }

    /// The cluster of a lane's least bound, the first of equals.
    #[inline(always)]
    pub(super) fn least(&self, lane: usize) -> u32 {
        let mut first = 0;
        for (cluster, errors) in self.errors.iter().enumerate() {
            first = if errors[lane] < self.errors[first][lane] { cluster } else { first };
        }
        first as u32
    }

    /// Takes the points' squared lengths, which are the distances from means that are 0.
    #[inline(always)]
    fn square(&mut self, points: &[Lanes]) {
        let mut squares = [0.0_f64; LANES];
        for values in points {
            for lane in 0..LANES {
                squares[lane] += f64::from(values[lane]) * f64::from(values[lane]);
            }
        }
        self.squares = squares.map(|square| square as f32);
        self.errors.fill(self.squares);
        self.distances.fill(self.squares);
    }

    /// Takes the products with one row of a cluster. A mean's row comes before those of its vectors.
    #[inline(always)]
    fn fold(&mut self, cluster: usize, kind: RowKind, products: &Lanes) {
        let (errors, distances) = (&mut self.errors[cluster], &mut self.distances[cluster]);
        match kind {
            RowKind::Mean(mean) => {
                for lane in 0..LANES {
                    distances[lane] = self.squares[lane] - 2.0 * products[lane] + mean;
                }
                *errors = *distances;
            }
            RowKind::Vector(offset) => {
                for lane in 0..LANES {
                    let along = products[lane] - offset;
                    errors[lane] -= along * along;
                }
            }
        }
    }

    #[inline(always)]
    fn subtract_bounds(&mut self, estimator: &Estimator) {
        let lengths = self.squares.map(f32::sqrt);
        for ((errors, distances), of) in self.errors.iter_mut().zip(&self.distances).zip(&estimator.bounds) {
            for lane in 0..LANES {
                errors[lane] -= bound(estimator.error, lengths[lane] + of.mean, distances[lane], of.vectors) + of.rest;
            }
        }
    }
}

/// How far an estimate may be off. `error` is e, `sum` is S, `distance` the estimate of D^2.
#[inline(always)]
fn bound(error: f32, sum: f32, distance: f32, (vectors, root_of_vectors): (f32, f32)) -> f32 {
    let weight = error * sum;
    // The estimate of D^2 is itself off by at most e S^2.
    let distance = (distance + weight * sum).max(0.0);
    let squares = 2.0 * root_of_vectors * weight * distance.sqrt() + vectors * weight * weight;
    weight * sum + squares + 4.0 * (vectors + 8.0) * UNIT * distance
}
