//! Lower bounds, in f32, of the squared error of each point's approximation by each cluster.
//!
//! Points and subspaces are taken relative to a center g and scaled by a power of two, so that points have at most
//! length 1. With X = |x - g|, M = |x_0 - g|, S = X + M, D = |x - x_0| and n' vectors, an inner product of n terms in
//! f32, summed in chunks, has an error of at most e times the lengths of its vectors,
//! `e = (CHUNK + n / CHUNK + 8) 2^-24`. A weight then has an error of at most e S, a sum of n' squared weights
//! `2 sqrt(n') D e S + n' (e S)^2` because it is at most D^2, and D^2 an error of e S^2. [`bound`] is their sum plus
//! the rounding of the additions. [`REST`] `(1 + M)^2` bounds the f64 rounding of the errors by which clusters are
//! chosen.

use super::products::{ROWS, add_slices};
use crate::linalg::dot;

/// Number of points that are estimated in parallel.
pub(super) const LANES: usize = 16;
/// Number of terms of an inner product that are summed before they are added to the total.
const CHUNK: usize = 32;
/// The relative rounding error of an operation in f32.
const UNIT: f32 = 1.0 / (1 << 24) as f32;
/// Bound of the rounding of a squared error in f64, relative to the squared distance from the mean: about
/// `2 sqrt(n') (n / 8 + 4) 2^-53`, plus the threshold below which an error counts as 0.
const REST: f32 = 1.0 / (1 << 30) as f32;
/// Bound of the root of [`REST`] plus the rounding of [`ScaledSubspace`].
const ROOT_OF_REST: f32 = 1.0 / (1 << 14) as f32;
/// Added to each bound against underflow of products in f32; lengths are at most 1.
const SMALL: f32 = 1e-30;

type Lanes = [f32; LANES];

/// The kind of a row of the estimator.
#[derive(Clone, Copy, Debug)]
enum RowKind {
    /// A cluster's mean, with its squared length.
    Mean(f32),
    /// A cluster's vector, with the mean's weight on it.
    Vector(f32),
}

/// A subspace relative to g and scaled, possibly projected onto fewer dimensions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ScaledSubspace {
    /// Number of components of a vector.
    pub(super) dimension: usize,
    /// M, before the projection.
    pub(super) length: f64,
    /// The mean, with one number per component; empty if it is 0.
    pub(super) offset: Vec<f64>,
    /// Orthonormal vectors, concatenated.
    pub(super) vectors: Vec<f64>,
}

/// Subspaces in f32.
#[derive(Debug)]
pub(super) struct Estimator {
    dimension: usize,
    /// Rows, concatenated cluster by cluster, and a final row of zeros.
    rows: Vec<f32>,
    kinds: Vec<RowKind>,
    /// The index of each cluster's first row, followed by the number of rows.
    begins: Vec<usize>,
    bounds: Vec<ClusterBound>,
    error: f32,
}

/// Parameters of the error bound for one cluster.
#[derive(Clone, Copy, Debug)]
struct ClusterBound {
    /// M.
    mean: f32,
    /// n' and its square root.
    vectors: (f32, f32),
    /// The part that does not depend on the point.
    rest: f32,
}

/// Lower bounds of squared errors for a group of points, for a list of clusters.
#[derive(Clone, Debug, Default)]
pub(super) struct LowerBounds {
    /// Per row its cluster's position in the list, and its index among all rows.
    rows: Vec<(usize, usize)>,
    errors: Vec<Lanes>,
    distances: Vec<Lanes>,
    squares: Lanes,
}

impl Estimator {
    /// An estimator of subspaces, which must have the same dimension.
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
        // The row of zeros pads tiles with fewer rows than a tile holds.
        rows.resize(rows.len() + dimension, 0.0);
        let error = (CHUNK + dimension / CHUNK + 8) as f32 * UNIT;
        Self { dimension, rows, kinds, begins, bounds, error }
    }

    /// Computes lower bounds of the squared errors of a group of points for some clusters.
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

    /// A lower bound of a point's distance from a cluster's subspace, given the lower bound of its squared error. It
    /// includes the rounding error of deriving another point's distance from it.
    #[inline(always)]
    pub(super) fn distance(&self, cluster: u32, lower: f32) -> f32 {
        lower.max(0.0).sqrt() - ROOT_OF_REST * (1.0 + self.bounds[cluster as usize].mean)
    }
}

impl LowerBounds {
    /// The bounds, one array of lanes per cluster.
    #[inline(always)]
    pub(super) fn lanes(&self) -> &[[f32; LANES]] {
        &self.errors
    }

    /// Sets squared errors to the points' squared lengths, which are right for means of 0.
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

    /// Adds the products with one row of one cluster. A mean's row comes before those of its vectors.
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

/// Bound of the error of an estimate. `error` is e, `sum` is S, `distance` the estimate of D^2.
#[inline(always)]
fn bound(error: f32, sum: f32, distance: f32, (vectors, root_of_vectors): (f32, f32)) -> f32 {
    let weight = error * sum;
    // The estimate of D^2 itself has an error of at most e S^2.
    let distance = (distance + weight * sum).max(0.0);
    let squares = 2.0 * root_of_vectors * weight * distance.sqrt() + vectors * weight * weight;
    weight * sum + squares + 4.0 * (vectors + 8.0) * UNIT * distance
}
