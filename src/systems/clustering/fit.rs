//! Principal components of a cluster (section 4.1).

use refsim::exec::batch::SimdLevel;

use super::products::{COLUMNS, KeptProducts, Packed, ROWS, add_block, add_orthonormal, add_products, square};
use super::{AffineSubspace, CpcaForm, Signal};
use crate::error::InputError;
use crate::linalg::{LeadingEigen, Matrix};

/// Threshold relative to a cluster's largest eigenvalue: eigenvalues up to it count as rounding errors, and get no
/// vectors.
pub(super) const NO_EIGENVALUE: f64 = 1.0 / (1u64 << 44) as f64;

/// Points per chunk of C^T C; it fixes the order of the additions.
const CHUNK: usize = 512;

/// A cluster's subspace, and its squared error.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fitted {
    pub(super) subspace: AffineSubspace,
    /// Numbers whose sum is the squared error of the cluster's points: the eigenvalues that have no vector, if known.
    left: Vec<f64>,
}

impl Fitted {
    pub(super) fn at(mean: Vec<f64>) -> Self {
        Self { subspace: AffineSubspace::at(mean), left: Vec::new() }
    }

    /// The squared error of all points of the cluster.
    pub(super) fn squared_error(&self) -> f64 {
        self.left.iter().sum()
    }

    /// All eigenvalues above the threshold, largest first. After a fit without vectors, none are known.
    pub(super) fn eigenvalues(&self) -> Vec<f64> {
        let all: Vec<f64> = self.subspace.eigenvalues.iter().chain(&self.left).copied().collect();
        let kept = all.iter().take_while(|&&value| value > all[0] * NO_EIGENVALUE).count();
        all[..kept].to_vec()
    }

    /// Keeps the first `count` vectors, or all if there are fewer.
    pub(super) fn truncate(&mut self, count: usize) {
        let cut = self.subspace.eigenvalues.iter().skip(count).copied();
        self.left = cut.chain(self.left.iter().copied()).collect();
        self.subspace.truncate(count);
    }
}

/// Fits the mean of at least one point, and the first `count` principal components; fewer if the residuals have a lower
/// rank. In the linear form with vectors the mean is 0, and inner products of the points are kept for the next fit.
pub(super) fn fit(
    signal: &Signal,
    points: &[u32],
    count: usize,
    form: CpcaForm,
    level: SimdLevel,
    kept: &mut KeptProducts,
) -> Result<Fitted, InputError> {
    let linear = form == CpcaForm::Linear && count > 0;
    let mean = if linear {
        vec![0.0; signal.dimension()]
    } else {
        level.run(
            #[inline(always)]
            || mean(signal, points),
        )
    };
    if count == 0 || (points.len() == 1 && !linear) {
        let squared_error = points.iter().map(|&point| squared_distance(signal.point(point as usize), &mean)).sum();
        return Ok(Fitted { subspace: AffineSubspace::at(mean), left: vec![squared_error] });
    }
    let residuals = Residuals { signal, points, mean: &mean, level };
    // C^T C and C C^T have the same eigenvalues other than 0, so the smaller matrix is decomposed.
    let Principal { mut values, vectors } = if points.len() >= signal.dimension() {
        Principal::of_components(&residuals.between_components()?, count, level)?
    } else if linear {
        let products = residuals.between_points(kept)?;
        let found = Principal::of_points(&residuals, &products, count)?;
        kept.keep(points, products);
        found
    } else {
        Principal::of_points(&residuals, &residuals.between_points(&KeptProducts::default())?, count)?
    };
    let found = vectors.len() / mean.len();
    let left = values.split_off(found).into_iter().map(|value| value.max(0.0)).collect();
    Ok(Fitted { subspace: AffineSubspace { mean, vectors, eigenvalues: values }, left })
}

/// The first `count` principal vectors of some points minus a center, concatenated.
pub(super) fn principal_vectors(
    signal: &Signal,
    points: &[u32],
    center: &[f64],
    count: usize,
    level: SimdLevel,
) -> Result<Vec<f64>, InputError> {
    let residuals = Residuals { signal, points, mean: center, level };
    let products = residuals.between_points(&KeptProducts::default())?;
    Ok(Principal::of_points(&residuals, &products, count)?.vectors)
}

/// All eigenvalues, largest first, and the leading vectors.
struct Principal {
    values: Vec<f64>,
    vectors: Vec<f64>,
}

impl Principal {
    fn of_components(products: &Matrix, count: usize, level: SimdLevel) -> Result<Self, InputError> {
        let (eigen, kept) = leading(products, count, level)?;
        let vectors = eigen.vectors.rows().take(kept).flatten().copied().collect();
        Ok(Self { values: eigen.values, vectors })
    }

    fn of_points(residuals: &Residuals<'_>, products: &Matrix, count: usize) -> Result<Self, InputError> {
        let (eigen, kept) = leading(products, count, residuals.level)?;
        let length = residuals.mean.len();
        let combined = residuals.combined(&eigen.vectors, kept);
        let mut vectors = Vec::with_capacity(combined.len());
        residuals.level.run(
            #[inline(always)]
            || combined.chunks_exact(length).all(|vector| add_orthonormal(&mut vectors, vector.to_vec(), 0.0)),
        );
        Ok(Self { values: eigen.values, vectors })
    }
}

/// Eigenvalues and leading vectors, and the number of vectors above the threshold.
fn leading(products: &Matrix, count: usize, level: SimdLevel) -> Result<(LeadingEigen, usize), InputError> {
    let eigen = level.run(
        #[inline(always)]
        || LeadingEigen::new(products, count),
    )?;
    let least = eigen.values[0] * NO_EIGENVALUE;
    let kept = eigen.values.iter().take(count).take_while(|&&value| value > least).count();
    Ok((eigen, kept))
}

#[inline(always)]
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

/// The matrix C of a cluster: its points minus the mean, one row each.
struct Residuals<'a> {
    signal: &'a Signal,
    points: &'a [u32],
    mean: &'a [f64],
    level: SimdLevel,
}

impl Residuals<'_> {
    /// Writes a point's residual from component `first` on.
    fn part(&self, point: u32, first: usize, into: &mut [f64]) {
        let values = self.signal.point(point as usize)[first..].iter().zip(&self.mean[first..]);
        into.iter_mut().zip(values).for_each(|(into, (&value, mean))| *into = f64::from(value) - mean);
    }

    /// Computes C C^T: the inner products of the points' residuals.
    fn between_points(&self, kept: &KeptProducts) -> Result<Matrix, InputError> {
        kept.of(self.points, self.mean.len(), self.level, |point, into| self.part(point, 0, into))
    }

    /// C^T C, computed in chunks of points.
    fn between_components(&self) -> Result<Matrix, InputError> {
        let mut products = square(self.mean.len())?;
        for chunk in self.points.chunks(CHUNK) {
            let part = |at: usize, first: usize, into: &mut [f64]| self.part(chunk[at], first, into);
            let (size, length) = (self.mean.len(), chunk.len());
            let (rows, columns) = (Packed::across(size, length, part), Packed::across(size, length, part));
            add_products(&mut products, &rows, &columns, self.level);
        }
        Ok(products)
    }

    /// C^T u for the first vectors u, concatenated: linear combinations of the points' residuals.
    fn combined(&self, weights: &Matrix, count: usize) -> Vec<f64> {
        let (length, points) = (self.mean.len(), self.points.len());
        let rows = Packed::<ROWS>::new(count, points, |at, into| into.copy_from_slice(weights.row(at)));
        let part = |at: usize, first: usize, into: &mut [f64]| self.part(self.points[at], first, into);
        let columns = Packed::<COLUMNS>::across(length, points, part);
        let mut combined = vec![0.0; count * length];
        for (rows, into) in rows.groups().zip(combined.chunks_mut(ROWS * length)) {
            for (group, columns) in columns.groups().enumerate() {
                let mut sums = [[0.0; COLUMNS]; ROWS];
                self.level.run(
                    #[inline(always)]
                    || add_block(rows, columns, &mut sums),
                );
                for (into, sums) in into.chunks_exact_mut(length).zip(&sums) {
                    into[group * COLUMNS..].iter_mut().zip(sums).for_each(|(into, &sum)| *into = sum);
                }
            }
        }
        combined
    }
}
