//! A compressed signal.

use super::{AffineSubspace, CpcaForm};
use crate::error::{InputError, ensure, input_error};
use crate::linalg::dot;
use crate::transfer::Signal;

/// Tolerance of the inner products of a subspace's vectors, which should be 0 and 1.
const ORTHONORMAL: f64 = 1e-6;

/// A signal as clusters: per cluster an affine subspace, per point its cluster and its weights on the subspace's
/// vectors.
#[derive(Clone, Debug, PartialEq)]
pub struct Clustering {
    dimension: usize,
    subspaces: Vec<AffineSubspace>,
    of_point: Vec<u32>,
    /// Point by point, as many as the point's subspace has vectors.
    weights: Vec<f64>,
    /// The index of each point's first weight, followed by the number of weights.
    begins: Vec<usize>,
}

fn not_finite_error(what: &'static str, index: usize) -> InputError {
    input_error!("expected finite numbers, found others in {what} {index}")
}

impl Clustering {
    /// A clustering of its parts: per cluster its subspace, per point its cluster, and all weights, point by point, as
    /// many as the point's subspace has vectors.
    ///
    /// # Errors
    /// [`InputError`].
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

    /// Points in given clusters, with their weights on the clusters' vectors.
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

    /// Per point its cluster.
    pub fn of_point(&self) -> &[u32] {
        &self.of_point
    }

    /// All weights, point by point.
    pub fn all_weights(&self) -> &[f64] {
        &self.weights
    }

    /// A point's weights, one per vector of its cluster.
    ///
    /// # Panics
    /// If there is no such point.
    pub fn weights(&self, point: usize) -> &[f64] {
        &self.weights[self.begins[point]..self.begins[point + 1]]
    }

    /// Linear if all means are 0, which is the same then.
    pub fn form(&self) -> CpcaForm {
        let linear = self.subspaces.iter().all(|subspace| subspace.mean.iter().all(|&value| value == 0.0));
        if linear { CpcaForm::Linear } else { CpcaForm::Affine }
    }

    /// Numbers that are stored but for the clusters of points: weights, means unless all are 0, and vectors. With n'
    /// vectors in each cluster this is m_p n' + m_c (n' + 1) n (section 4.1), and m_c n' n in the linear form.
    pub fn stored_numbers(&self) -> usize {
        let means = if self.form() == CpcaForm::Linear { 0 } else { self.subspaces.len() * self.dimension };
        self.weights.len() + means + self.subspaces.iter().map(|s| s.vectors.len()).sum::<usize>()
    }

    /// The approximation of a point: `dimension` numbers.
    ///
    /// # Panics
    /// If there is no such point, or `into` has another length.
    pub fn approximation(&self, point: usize, into: &mut [f64]) {
        self.subspaces[self.of_point[point] as usize].approximation(self.weights(point), into);
    }

    /// The squared error of a point's approximation.
    ///
    /// # Panics
    /// If the signal has another shape, or there is no such point.
    pub fn squared_error_of(&self, point: usize, signal: &Signal) -> f64 {
        let mut difference = vec![0.0; self.dimension];
        self.approximation(point, &mut difference);
        let values = signal.point(point);
        difference.iter_mut().zip(values).for_each(|(d, &value)| *d -= f64::from(value));
        dot(&difference, &difference)
    }

    /// The squared error of all points' approximations, summed: the paper's SE.
    ///
    /// # Panics
    /// If the signal has another shape.
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
         found others"
    );
    if !mean.iter().chain(vectors).chain(eigenvalues).all(|value| value.is_finite()) {
        return Err(not_finite_error("cluster", cluster));
    }
    ensure!(
        eigenvalues.iter().chain(&[0.0]).is_sorted_by(|a, b| a >= b),
        "expected eigenvalues of at least 0 in decreasing order in cluster {cluster}, found others"
    );
    for (i, a) in subspace.vectors().enumerate() {
        let wrong = |(j, b)| (dot(a, b) - f64::from(u8::from(i == j))).abs() > ORTHONORMAL;
        ensure!(
            !subspace.vectors().enumerate().take(i + 1).any(wrong),
            "expected orthonormal vectors in cluster {cluster}, found others"
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

#[cfg(test)]
mod tests {
    use super::*;

    fn subspace() -> AffineSubspace {
        AffineSubspace { mean: vec![1.0, 2.0], vectors: vec![0.6, 0.8], eigenvalues: vec![3.0] }
    }

    #[test]
    fn an_approximation_is_the_mean_and_weighted_vectors() {
        let alone = AffineSubspace { mean: vec![-1.0, 0.0], vectors: vec![], eigenvalues: vec![] };
        let clustering = Clustering::new(vec![subspace(), alone], vec![1, 0], vec![10.0]).expect("a clustering");
        let mut point = [0.0; 2];
        clustering.approximation(1, &mut point);
        assert_eq!((point, clustering.weights(0), clustering.weights(1)), ([7.0, 10.0], &[][..], &[10.0][..]));
        let signal = Signal::new(2, vec![-1.0, 2.0, 7.0, 9.0]).expect("a signal");
        assert_eq!(clustering.squared_error(&signal), 4.0 + 1.0);
        assert_eq!(clustering.stored_numbers(), 1 + 2 + 2 + 2);
    }

    #[test]
    fn parts_that_do_not_go_together_are_refused() {
        let new = |change: &dyn Fn(&mut AffineSubspace), of_point, weights| {
            let mut subspace = subspace();
            change(&mut subspace);
            Clustering::new(vec![subspace], of_point, weights).expect_err("refused")
        };
        let same = |_: &mut AffineSubspace| ();
        assert_eq!(
            new(&same, vec![], vec![]).to_string(),
            "expected clusters and points, found 1 clusters and 0 points of 2 numbers"
        );
        assert_eq!(new(&same, vec![1], vec![1.0]).to_string(), "expected a cluster below 1 for point 0, found 1");
        assert_eq!(new(&same, vec![0], vec![]).to_string(), "expected 1 weights, found 0");
        let (what, index) = ("weight", 0);
        assert_eq!(new(&same, vec![0], vec![f64::NAN]), not_finite_error(what, index));
        let broken = |change: &dyn Fn(&mut AffineSubspace)| new(change, vec![0], vec![1.0]);
        let cluster = 0;
        assert_eq!(
            broken(&|s| s.vectors.push(0.0)),
            input_error!("expected a mean of 2 numbers and as many per eigenvalue in cluster {cluster}, found others")
        );
        assert_eq!(
            broken(&|s| s.vectors[0] = 0.7),
            input_error!("expected orthonormal vectors in cluster {cluster}, found others")
        );
        assert_eq!(
            broken(&|s| s.eigenvalues[0] = -1.0),
            input_error!("expected eigenvalues of at least 0 in decreasing order in cluster {cluster}, found others")
        );
        let what = "cluster";
        assert_eq!(broken(&|s| s.mean[0] = f64::INFINITY), not_finite_error(what, 0));
    }
}
