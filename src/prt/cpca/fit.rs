//! Principal components of a cluster (section 4.1).

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::products::{Packed, ROWS, add_block};
use super::{AffineSubspace, CpcaForm};
use crate::linalg::{FactorError, LeadingEigen, Matrix, dot, make_largest_positive};
use crate::prt::Signal;

/// The share of a cluster's largest eigenvalue up to which others are rounding, and have no vectors.
pub(super) const NO_EIGENVALUE: f64 = 1.0 / (1u64 << 44) as f64;

/// Columns of a block.
const COLUMNS: usize = 8;
/// Points per chunk of C^T C: part of the shape of its sums.
const CHUNK: usize = 512;
/// Products of fewer numbers than this are made by one thread.
const MIN_PARALLEL: usize = 1 << 22;

/// A cluster's subspace, and what it leaves.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fitted {
    pub(super) subspace: AffineSubspace,
    /// What sums to the squared error of the cluster's points: the eigenvalues without vectors, where they are known.
    left: Vec<f64>,
}

impl Fitted {
    /// A mean alone, of points without error.
    pub(super) fn at(mean: Vec<f64>) -> Self {
        Self { subspace: AffineSubspace::at(mean), left: Vec::new() }
    }

    /// The squared error of all points of the cluster.
    pub(super) fn squared_error(&self) -> f64 {
        self.left.iter().sum()
    }

    /// All eigenvalues that may have a vector, the largest first. Fitted with no vector, none are known.
    pub(super) fn eigenvalues(&self) -> Vec<f64> {
        let all: Vec<f64> = self.subspace.eigenvalues.iter().chain(&self.left).copied().collect();
        let kept = all.iter().take_while(|&&value| value > all[0] * NO_EIGENVALUE).count();
        all[..kept].to_vec()
    }

    /// Leaves the first vectors, `count` of them or all.
    pub(super) fn truncate(&mut self, count: usize) {
        let cut = self.subspace.eigenvalues.iter().skip(count).copied();
        self.left = cut.chain(self.left.iter().copied()).collect();
        self.subspace.truncate(count);
    }
}

/// The mean of some points, at least one, and their `count` first principal components; fewer where the residuals have
/// a lower rank. In the linear form the mean is 0 once there are vectors.
pub(super) fn fit(
    signal: &Signal,
    points: &[u32],
    count: usize,
    form: CpcaForm,
    level: SimdLevel,
) -> Result<Fitted, FactorError> {
    let linear = form == CpcaForm::Linear && count > 0;
    let mean = if linear { vec![0.0; signal.dimension()] } else { mean(signal, points) };
    if count == 0 || (points.len() == 1 && !linear) {
        let squared_error = points.iter().map(|&point| squared_distance(signal.point(point as usize), &mean)).sum();
        return Ok(Fitted { subspace: AffineSubspace::at(mean), left: vec![squared_error] });
    }
    let residuals = Residuals { signal, points, mean: &mean, level };
    let by_points = points.len() < signal.dimension();
    let products = if by_points { residuals.between_points() } else { residuals.between_components() };
    let eigen = LeadingEigen::new(&products?, count)?;
    let least = eigen.values[0] * NO_EIGENVALUE;
    let kept = eigen.values.iter().take(count).take_while(|&&value| value > least).count();
    let mut vectors = Vec::with_capacity(kept * mean.len());
    for vector in eigen.vectors.rows().take(kept) {
        if by_points {
            let direction = residuals.combined(vector);
            push_orthonormal(&mut vectors, direction);
        } else {
            vectors.extend_from_slice(vector);
        }
    }
    let left = eigen.values[kept..].iter().map(|&value| value.max(0.0)).collect();
    let eigenvalues = eigen.values[..kept].to_vec();
    Ok(Fitted { subspace: AffineSubspace { mean, vectors, eigenvalues }, left })
}

fn mean(signal: &Signal, points: &[u32]) -> Vec<f64> {
    let mut mean = vec![0.0; signal.dimension()];
    for &point in points {
        mean.iter_mut().zip(signal.point(point as usize)).for_each(|(sum, &value)| *sum += f64::from(value));
    }
    mean.iter_mut().for_each(|sum| *sum /= points.len() as f64);
    mean
}

fn squared_distance(point: &[f32], mean: &[f64]) -> f64 {
    let differences = point.iter().zip(mean).map(|(&value, mean)| f64::from(value) - mean);
    differences.map(|difference| difference * difference).sum()
}

/// Adds a vector, made orthogonal to those before it, twice against rounding, and of length 1.
fn push_orthonormal(vectors: &mut Vec<f64>, mut vector: Vec<f64>) {
    for _ in 0..2 {
        for earlier in vectors.chunks_exact(vector.len()) {
            let along = dot(earlier, &vector);
            vector.iter_mut().zip(earlier).for_each(|(value, earlier)| *value -= along * earlier);
        }
        let length = dot(&vector, &vector).sqrt();
        vector.iter_mut().for_each(|value| *value /= length);
    }
    make_largest_positive(&mut vector);
    vectors.extend(vector);
}

/// The matrix C of a cluster: its points less the mean, a row each.
struct Residuals<'a> {
    signal: &'a Signal,
    points: &'a [u32],
    mean: &'a [f64],
    level: SimdLevel,
}

impl Residuals<'_> {
    fn row(&self, at: usize, into: &mut [f64]) {
        let values = self.signal.point(self.points[at] as usize).iter().zip(self.mean);
        into.iter_mut().zip(values).for_each(|(into, (&value, mean))| *into = f64::from(value) - mean);
    }

    /// C C^T.
    fn between_points(&self) -> Result<Matrix, FactorError> {
        let mut products = square(self.points.len())?;
        let length = self.mean.len();
        let row = |at: usize, into: &mut [f64]| self.row(at, into);
        self.add(&mut products, length, row);
        Ok(products)
    }

    /// C^T C, a chunk of points at a time.
    fn between_components(&self) -> Result<Matrix, FactorError> {
        let dimension = self.mean.len();
        let mut products = square(dimension)?;
        for chunk in self.points.chunks(CHUNK) {
            let component = |j: usize, into: &mut [f64]| {
                let values = chunk.iter().map(|&point| f64::from(self.signal.point(point as usize)[j]) - self.mean[j]);
                into.iter_mut().zip(values).for_each(|(into, value)| *into = value);
            };
            self.add(&mut products, chunk.len(), component);
        }
        Ok(products)
    }

    /// Adds the products of all pairs of vectors to the lower triangle; what stands above it is not used.
    fn add(&self, products: &mut Matrix, length: usize, vector: impl Fn(usize, &mut [f64])) {
        let size = products.row_count();
        let (rows, columns) =
            (Packed::<f64, ROWS>::new(size, length, &vector), Packed::<f64, COLUMNS>::new(size, length, &vector));
        let rows: Vec<_> = rows.groups().collect();
        let add_rows = |tile: usize, into: &mut [f64]| {
            self.level.run(
                #[inline(always)]
                || {
                    for (group, column) in columns.groups().enumerate().take(((tile + 1) * ROWS).div_ceil(COLUMNS)) {
                        let mut sums = [[0.0; COLUMNS]; ROWS];
                        add_block(rows[tile], column, &mut sums);
                        for (row, sums) in into.chunks_exact_mut(size).zip(&sums) {
                            for (into, sum) in row[group * COLUMNS..].iter_mut().zip(sums) {
                                *into += sum;
                            }
                        }
                    }
                },
            );
        };
        let mut all: Vec<&mut [f64]> = products.row_blocks_mut(ROWS).collect();
        if size * size * length < MIN_PARALLEL {
            all.iter_mut().enumerate().for_each(|(tile, into)| add_rows(tile, into));
        } else {
            all.par_iter_mut().enumerate().for_each(|(tile, into)| add_rows(tile, into));
        }
    }

    /// C^T u: a combination of the points' residuals.
    fn combined(&self, weights: &[f64]) -> Vec<f64> {
        let (mut sum, mut row) = (vec![0.0; self.mean.len()], vec![0.0; self.mean.len()]);
        for (at, weight) in weights.iter().enumerate() {
            self.row(at, &mut row);
            sum.iter_mut().zip(&row).for_each(|(sum, value)| *sum += weight * value);
        }
        sum
    }
}

fn square(size: usize) -> Result<Matrix, FactorError> {
    Matrix::zeros([size; 2]).map_err(FactorError::from)
}
