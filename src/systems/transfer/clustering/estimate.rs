//! Estimates in f32 of the squared error that each cluster leaves at each point, with bounds of how far they are off.
//!
//! Points and subspaces are taken relative to a center g and scaled by a power of two, so that no point is longer
//! than 1. With X = |x - g|, M = |x_0 - g|, S = X + M, D = |x - x_0| and n' vectors, an inner product of n
//! terms in f32, summed in chunks, is off by at most e times the lengths of its vectors,
//! `e = (CHUNK + n / CHUNK + 8) 2^-24`. A weight is then off by at most e S, a sum of n' squared weights by
//! `2 sqrt(n') D e S + n' (e S)^2` because it is at most D^2, and D^2 by e S^2. [`bound`] is their sum with the
//! rounding of the additions. [`REST`] `(1 + M)^2` stands for what f64 rounds in the errors that are decided by.

use super::products::{ROWS, add_slices};
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
/// More than the root of what [`REST`] and the rounding of [`ScaledSubspace`] stand for.
const ROOT_OF_REST: f32 = 1.0 / (1 << 14) as f32;
/// Added to each bound, against products too small for f32; lengths are at most 1.
const SMALL: f32 = 1e-30;

type Lanes = [f32; LANES];

/// A row of the estimates: which vector of a cluster.
#[derive(Clone, Copy, Debug)]
enum RowKind {
    /// The cluster's mean, with its squared length.
    Mean(f32),
    /// One of its vectors, with the mean's weight on it.
    Vector(f32),
}

/// A subspace relative to g and scaled, perhaps projected onto fewer dimensions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ScaledSubspace {
    /// The numbers of a vector.
    pub(super) dimension: usize,
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
    dimension: usize,
    /// One after another, cluster by cluster, and one of zeros.
    rows: Vec<f32>,
    kinds: Vec<RowKind>,
    /// Where each cluster's rows begin, and the last end.
    begins: Vec<usize>,
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

/// Lower bounds of squared errors for a group of points, for one of some clusters after another.
#[derive(Clone, Debug, Default)]
pub(super) struct LowerBounds {
    /// Which of the clusters each row is of, and which row it is.
    rows: Vec<(usize, usize)>,
    errors: Vec<Lanes>,
    distances: Vec<Lanes>,
    squares: Lanes,
}

impl Estimator {
    /// Of subspaces, all of the same dimension.
    pub(super) fn new(subspaces: &[ScaledSubspace]) -> Self {
        let dimension = subspaces.first().map_or(1, |subspace| subspace.dimension);
        let (mut kinds, mut bounds, mut rows, mut begins) = (Vec::new(), Vec::new(), Vec::new(), vec![0]);
        for ScaledSubspace { length, offset, vectors, .. } in subspaces {
            if !offset.is_empty() {
                kinds.push(RowKind::Mean(dot(offset, offset) as f32));
            }
            kinds.extend(vectors.chunks_exact(dimension).map(|vector| RowKind::Vector(dot(vector, offset) as f32)));
            rows.extend(offset.iter().chain(vectors).map(|&value| value as f32));
            begins.push(kinds.len());
            let (mean, vectors) = (*length as f32, (vectors.len() / dimension) as f32);
            let rest = SMALL + REST * (1.0 + mean) * (1.0 + mean);
            bounds.push(ClusterBound { mean, vectors: (vectors, vectors.sqrt()), rest });
        }
        rows.resize(rows.len() + dimension, 0.0);
        let error = (CHUNK + dimension / CHUNK + 8) as f32 * UNIT;
        Self { dimension, rows, kinds, begins, bounds, error }
    }

    /// Bounds of some clusters for a group of points: no error is below its bound.
    #[inline(always)]
    pub(super) fn estimate(&self, points: &[Lanes], clusters: &[u32], group: &mut LowerBounds) {
        group.begin(points, clusters.len());
        let mut rows = std::mem::take(&mut group.rows);
        rows.clear();
        for (at, &cluster) in clusters.iter().enumerate() {
            rows.extend((self.begins[cluster as usize]..self.begins[cluster as usize + 1]).map(|row| (at, row)));
        }
        let zeros = self.kinds.len();
        for tile in rows.chunks(ROWS) {
            let slices = std::array::from_fn(|i| {
                let row = tile.get(i).map_or(zeros, |&(_, row)| row);
                &self.rows[row * self.dimension..][..self.dimension]
            });
            let mut sums = [[0.0; LANES]; ROWS];
            for (chunk, points) in points.chunks(CHUNK).enumerate() {
                add_slices(slices.map(|row| &row[chunk * CHUNK..][..points.len()]), points, &mut sums);
            }
            for (&(at, row), sums) in tile.iter().zip(&sums) {
                group.fold(at, self.kinds[row], sums);
            }
        }
        group.rows = rows;
        group.subtract_bounds(self, clusters);
    }

    /// At least how far a point is from a cluster's subspace, if that is `lower` for its squared error: less by what is
    /// lost to rounding where the distance of another point follows from it.
    #[inline(always)]
    pub(super) fn distance(&self, cluster: u32, lower: f32) -> f32 {
        lower.max(0.0).sqrt() - ROOT_OF_REST * (1.0 + self.bounds[cluster as usize].mean)
    }
}

impl LowerBounds {
    /// The bounds lane by lane, one of the clusters after another.
    #[inline(always)]
    pub(super) fn lanes(&self) -> &[[f32; LANES]] {
        &self.errors
    }

    /// Takes the points' squared lengths, which are the distances from means that are 0.
    #[inline(always)]
    fn begin(&mut self, points: &[Lanes], clusters: usize) {
        let mut squares = [0.0_f64; LANES];
        for values in points {
            for lane in 0..LANES {
                squares[lane] += f64::from(values[lane]) * f64::from(values[lane]);
            }
        }
        self.squares = squares.map(|square| square as f32);
        for values in [&mut self.errors, &mut self.distances] {
            values.clear();
            values.resize(clusters, self.squares);
        }
    }

    /// Takes the products with one row of one of the clusters. A mean's row comes before those of its vectors.
    #[inline(always)]
    fn fold(&mut self, at: usize, kind: RowKind, products: &Lanes) {
        let (errors, distances) = (&mut self.errors[at], &mut self.distances[at]);
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
    fn subtract_bounds(&mut self, estimator: &Estimator, clusters: &[u32]) {
        let lengths = self.squares.map(f32::sqrt);
        for ((errors, distances), &cluster) in self.errors.iter_mut().zip(&self.distances).zip(clusters) {
            let of = &estimator.bounds[cluster as usize];
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
