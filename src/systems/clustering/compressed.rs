//! The affine subspace of a cluster, and a signal compressed by such subspaces.

use super::products::dots;
use super::{CpcaForm, Signal};
use crate::error::{InputError, ensure, input_error};
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
    /// For each vector, the squared singular value D_i^2 of the cluster's residuals, in decreasing order.
    pub eigenvalues: Vec<f64>,
}

impl AffineSubspace {
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

/// Tolerance of the inner products of a subspace's vectors, which should be 0 and 1.
const ORTHONORMAL: f64 = 1e-6;

/// A signal as clusters: an affine subspace per cluster, and for each point its cluster and its weights on the
/// subspace's vectors.
#[derive(Clone, Debug, PartialEq)]
pub struct Clustering {
    dimension: usize,
    subspaces: Vec<AffineSubspace>,
    of_point: Vec<u32>,
    /// Weights point by point: one for each vector of the point's subspace.
    weights: Vec<f64>,
    /// The index of each point's first weight, followed by the number of weights.
    begins: Vec<usize>,
}

fn not_finite_error(what: &'static str, index: usize) -> InputError {
    input_error!("expected finite numbers, found other numbers in {what} {index}")
}

impl Clustering {
    /// Creates a clustering from its parts: a subspace per cluster, the cluster of each point, and all weights, point
    /// by point, one for each vector of the point's subspace.
    pub fn new(subspaces: Vec<AffineSubspace>, of_point: Vec<u32>, weights: Vec<f64>) -> Result<Self, InputError> {
        let (clusters, points) = (subspaces.len(), of_point.len());
        let dimension = subspaces.first().map_or(0, |subspace| subspace.mean.len());
        ensure!(
            points != 0 && dimension != 0,
            "expected clusters and points, found {clusters} clusters and {points} points of {dimension} numbers"
        );
        for (cluster, subspace) in subspaces.iter().enumerate() {
            check_subspace(cluster, subspace, dimension)?;
        }
        let out = of_point.iter().position(|&found| found as usize >= clusters);
        if let Some(point) = out {
            return Err(input_error!(
                "expected a cluster below {clusters} for point {point}, found {}",
                of_point[point]
            ));
        }
        let begins = begins(&subspaces, &of_point);
        let expected = begins[points];
        ensure!(weights.len() == expected, "expected {expected} weights, found {}", weights.len());
        match weights.iter().position(|weight| !weight.is_finite()) {
            Some(index) => Err(not_finite_error("weight", index)),
            None => Ok(Self { dimension, subspaces, of_point, weights, begins }),
        }
    }

    /// Assigns points to given clusters, and computes their weights on the clusters' vectors.
    pub(crate) fn project(signal: &Signal, subspaces: Vec<AffineSubspace>, of_point: Vec<u32>) -> Self {
        let begins = begins(&subspaces, &of_point);
        let mut weights = Vec::with_capacity(begins[of_point.len()]);
        for (point, &cluster) in of_point.iter().enumerate() {
            weights.extend(subspaces[cluster as usize].weights(signal.point(point)));
        }
        Self { dimension: signal.dimension(), subspaces, of_point, weights, begins }
    }

    /// Numbers per point of the signal.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.of_point.len()
    }

    /// The subspaces, one per cluster.
    pub fn subspaces(&self) -> &[AffineSubspace] {
        &self.subspaces
    }

    /// The cluster of each point.
    pub fn of_point(&self) -> &[u32] {
        &self.of_point
    }

    /// All weights, point by point.
    pub fn all_weights(&self) -> &[f64] {
        &self.weights
    }

    /// A point's weights, one per vector of its cluster. Panics if there is no such point.
    pub fn weights(&self, point: usize) -> &[f64] {
        &self.weights[self.begins[point]..self.begins[point + 1]]
    }

    /// Linear if all means are 0; both forms are then equal.
    pub fn form(&self) -> CpcaForm {
        let linear = self.subspaces.iter().all(|subspace| subspace.mean.iter().all(|&value| value == 0.0));
        if linear { CpcaForm::Linear } else { CpcaForm::Affine }
    }

    /// Number of stored numbers, without the points' cluster indices: weights, means unless all are 0, and vectors.
    /// With n' vectors in each cluster this is m_p n' + m_c (n' + 1) n (section 4.1), and m_c n' n in the linear form.
    pub fn stored_numbers(&self) -> usize {
        let means = if self.form() == CpcaForm::Linear { 0 } else { self.subspaces.len() * self.dimension };
        self.weights.len() + means + self.subspaces.iter().map(|s| s.vectors.len()).sum::<usize>()
    }

    /// The approximation of a point: `dimension` numbers. Panics if there is no such point, or `into` has another
    /// length.
    pub fn approximation(&self, point: usize, into: &mut [f64]) {
        self.subspaces[self.of_point[point] as usize].approximation(self.weights(point), into);
    }

    /// The squared error of a point's approximation. Panics if the signal has another shape, or there is no such point.
    pub fn squared_error_of(&self, point: usize, signal: &Signal) -> f64 {
        let mut difference = vec![0.0; self.dimension];
        self.approximation(point, &mut difference);
        let values = signal.point(point);
        difference.iter_mut().zip(values).for_each(|(d, &value)| *d -= f64::from(value));
        dot(&difference, &difference)
    }

    /// The sum of squared errors of all points' approximations: the paper's SE. Panics if the signal has another shape.
    pub fn squared_error(&self, signal: &Signal) -> f64 {
        assert_eq!((signal.points(), signal.dimension()), (self.points(), self.dimension), "the signal's shape");
        signal.sum(|point| self.squared_error_of(point, signal))
    }
}

fn check_subspace(cluster: usize, subspace: &AffineSubspace, dimension: usize) -> Result<(), InputError> {
    let AffineSubspace { mean, vectors, eigenvalues } = subspace;
    ensure!(
        mean.len() == dimension && Some(vectors.len()) == eigenvalues.len().checked_mul(dimension),
        "expected a mean of {dimension} numbers and as many per eigenvalue in cluster {cluster}, \
         found other counts"
    );
    if !mean.iter().chain(vectors).chain(eigenvalues).all(|value| value.is_finite()) {
        return Err(not_finite_error("cluster", cluster));
    }
    ensure!(
        eigenvalues.iter().chain(&[0.0]).is_sorted_by(|a, b| a >= b),
        "expected eigenvalues of at least 0 in decreasing order in cluster {cluster}, found other eigenvalues"
    );
    for (i, a) in subspace.vectors().enumerate() {
        let wrong = |(j, b)| (dot(a, b) - f64::from(u8::from(i == j))).abs() > ORTHONORMAL;
        ensure!(
            !subspace.vectors().enumerate().take(i + 1).any(wrong),
            "expected orthonormal vectors in cluster {cluster}, found other vectors"
        );
    }
    Ok(())
}

fn begins(subspaces: &[AffineSubspace], of_point: &[u32]) -> Vec<usize> {
    let mut end = 0;
    let ends = of_point.iter().map(|&cluster| {
        end += subspaces[cluster as usize].len();
        end
    });
    std::iter::once(0).chain(ends).collect()
}
