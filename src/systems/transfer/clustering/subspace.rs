//! The affine subspace of a cluster: its mean and principal vectors.

use super::products::dots;
use crate::linalg::dot;

/// Threshold relative to the squared distance from the mean, below which a squared error counts as 0: well above the
/// f64 rounding of the sums, well below the precision of the f32 signal.
pub(super) const NO_ERROR: f64 = 1.0 / (1u64 << 40) as f64;

/// A mean and orthonormal vectors.
#[derive(Clone, Debug, PartialEq)]
pub struct AffineSubspace {
    /// The mean x_0, one number per dimension of the signal.
    pub mean: Vec<f64>,
    /// The vectors x_1, x_2, ..., concatenated, each with the length of the mean.
    pub vectors: Vec<f64>,
    /// Per vector the squared singular value D_i^2 of the cluster's residuals, decreasing.
    pub eigenvalues: Vec<f64>,
}

impl AffineSubspace {
    /// A mean without vectors.
    pub(super) fn at(mean: Vec<f64>) -> Self {
        Self { mean, vectors: Vec::new(), eigenvalues: Vec::new() }
    }

    /// Number of vectors.
    pub fn len(&self) -> usize {
        self.eigenvalues.len()
    }

    /// True if there are no vectors.
    pub fn is_empty(&self) -> bool {
        self.eigenvalues.is_empty()
    }

    /// The vectors, by decreasing eigenvalue.
    pub fn vectors(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.vectors.chunks_exact(self.mean.len())
    }

    /// Keeps the first `count` vectors, or all if there are fewer.
    pub(super) fn truncate(&mut self, count: usize) {
        self.vectors.truncate(count * self.mean.len());
        self.eigenvalues.truncate(count);
    }

    /// The squared error of a point's best approximation, by section 4.2's formula.
    #[inline(always)]
    pub(crate) fn squared_error(&self, point: &[f32], residual: &mut Vec<f64>) -> f64 {
        self.residual(point, residual);
        let distance = dot(residual, residual);
        let mut error = distance;
        dots(&self.vectors, residual, |along| error -= along * along);
        if error <= distance * NO_ERROR { 0.0 } else { error }
    }

    /// A point's weights: the inner products of its residual with the vectors.
    pub(super) fn weights(&self, point: &[f32]) -> impl Iterator<Item = f64> {
        let mut residual = Vec::new();
        self.residual(point, &mut residual);
        self.vectors().map(move |vector| dot(vector, &residual))
    }

    #[inline(always)]
    pub(super) fn residual(&self, point: &[f32], into: &mut Vec<f64>) {
        into.resize(point.len(), 0.0);
        into.iter_mut()
            .zip(point.iter().zip(&self.mean))
            .for_each(|(into, (&value, mean))| *into = f64::from(value) - mean);
    }

    /// x_0 + w_1 x_1 + w_2 x_2 + ...
    pub(super) fn approximation(&self, weights: &[f64], into: &mut [f64]) {
        into.copy_from_slice(&self.mean);
        for (weight, vector) in weights.iter().zip(self.vectors()) {
            into.iter_mut().zip(vector).for_each(|(value, component)| *value += weight * component);
        }
    }
}
