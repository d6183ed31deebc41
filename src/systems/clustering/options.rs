//! Options of the compression.

use super::Signal;
use crate::error::{InputError, ensure};
use crate::geom::random::CounterRng;

/// Options of the compression of a signal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CpcaOptions {
    /// Number of clusters m_c: from 1 to the number of points.
    pub clusters: usize,
    /// Number of vectors per cluster n': from 0 (vector quantisation) to the signal's dimension.
    pub vectors: usize,
    /// Largest number of iterations of vector quantisation (LBG), before the first vector; at least 1.
    pub vq_iterations: usize,
    /// Largest number of iterations for each number of vectors from 1 on; at least 1. The paper uses 10 to 20.
    pub iterations: usize,
    /// The measure by which points are assigned to clusters.
    pub method: CpcaMethod,
    /// The kind of approximation within a cluster.
    pub form: CpcaForm,
    /// Random seed of the first representatives, which are drawn from the points without replacement.
    pub seed: u64,
}

/// The kind of approximation within a cluster.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CpcaForm {
    /// Affine subspaces: a mean and principal vectors of the residuals (this system's paper, section 3.3).
    #[default]
    Affine,
    /// Linear subspaces: principal vectors of the raw second moment (equation 11 of the paper on all-frequency
    /// transfer). Without vectors, points are assigned by distance from means even in this form.
    Linear,
}

/// The measure by which points are assigned to clusters.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum CpcaMethod {
    /// Distance from the means; then principal components are computed once per cluster.
    ///
    /// Section 4.1.
    Static,
    /// Error of the approximation, while vectors are added one by one.
    ///
    /// Section 4.2.
    Iterative,
    /// Like iterative, but the number of vectors is doubled: 1, 2, 4 and so on up to the requested number.
    ///
    /// Not in the papers; for signals with thousands of dimensions, where it saves most of the time.
    Doubling,
    /// Like iterative, followed by redistribution of vectors among the clusters.
    ///
    /// Section 4.3.
    Adaptive {
        /// Largest number of rounds of redistribution.
        rounds: usize,
    },
}

impl CpcaMethod {
    /// The method with this maximum number of rounds of redistribution, if it redistributes.
    #[must_use]
    pub const fn with_rounds(self, rounds: usize) -> Self {
        match self {
            Self::Adaptive { .. } => Self::Adaptive { rounds },
            other => other,
        }
    }

    /// The successive numbers of vectors per cluster, up to `vectors`.
    pub(super) fn growth(self, vectors: usize) -> Vec<usize> {
        match self {
            Self::Static if vectors == 0 => Vec::new(),
            Self::Static => vec![vectors],
            Self::Iterative | Self::Adaptive { .. } => (1..=vectors).collect(),
            Self::Doubling => {
                let doubled =
                    std::iter::successors(Some(1), |count| Some(2 * count)).take_while(|&count| count < vectors);
                doubled.chain((vectors > 0).then_some(vectors)).collect()
            }
        }
    }
}

impl CpcaOptions {
    /// The start points, after a check of all options against a signal.
    pub(super) fn start_points(&self, signal: &Signal) -> Result<Vec<u32>, InputError> {
        let (points, dimension) = (signal.points(), signal.dimension());
        let &Self { clusters, vectors, vq_iterations, iterations, .. } = self;
        ensure!(
            (1..=points).contains(&clusters),
            "expected 1 to {points} clusters, one per point at most, found {clusters}"
        );
        ensure!(
            vectors <= dimension,
            "expected at most {dimension} vectors per cluster, one per dimension, found {vectors}"
        );
        ensure!(
            self.form == CpcaForm::Affine || vectors > 0,
            "expected at least 1 vector per cluster in the linear form, which has no means, found 0"
        );
        ensure!(vq_iterations.min(iterations) > 0, "expected at least 1 iteration for each number of vectors, found 0");
        Ok(draw(self.seed, points as u32, clusters))
    }
}

/// The first `count` points of a random permutation.
fn draw(seed: u64, points: u32, count: usize) -> Vec<u32> {
    let random = CounterRng::new(seed);
    let mut deck: Vec<u32> = (0..points).collect();
    for i in 0..count {
        let rest = (deck.len() - i) as u128;
        let at = (u128::from(random.bits(i as u64, 0, 0)) * rest) >> 64;
        deck.swap(i, i + at as usize);
    }
    deck.truncate(count);
    deck
}
