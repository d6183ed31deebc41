//! As much as a given error needs.

use refsim::exec::batch::SimdLevel;

use super::compress::{Compression, CpcaStep, compress, grow};
use super::{CpcaError, CpcaMethod, CpcaOptions, StartPoints};
use crate::transfer::Signal;

/// The number that grows until an error is met.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum Grown {
    /// Vectors per cluster, from 0 on as the method adds them: one by one, or doubled.
    #[default]
    Vectors,
    /// Clusters, from 1 on.
    ///
    /// Doubled, then halved in between. The number found meets the error; one cluster less does
    /// not. (Larger numbers may miss it again: the error of k-means does not fall with each cluster.)
    Clusters,
}

/// Compresses a signal until its squared error is at most `share` of its sum of squares, with `options.vectors` and
/// `options.clusters` at most. The result is that of [`compress`] with the number found; of given start points, those
/// of the first clusters. `observe` sees the steps of all that is tried.
///
/// # Errors
/// [`CpcaError`]: [`NotMet`](CpcaError::NotMet) if all that is allowed does not meet the error,
/// [`ErrorShare`](CpcaError::ErrorShare) unless 0 < `share` < 1, [`AdaptiveGoesOn`](CpcaError::AdaptiveGoesOn) for
/// vectors that are redistributed; the others as [`compress`].
pub fn compress_to_error(
    signal: &Signal,
    options: &CpcaOptions,
    share: f64,
    grown: Grown,
    mut observe: impl FnMut(&CpcaStep),
) -> Result<Compression, CpcaError> {
    if !(share > 0.0 && share < 1.0) {
        return Err(CpcaError::ErrorShare { found: share });
    }
    let limit = share * signal.sum_of_squares();
    let (error, compression) = match grown {
        Grown::Vectors if matches!(options.method, CpcaMethod::Adaptive { .. }) => {
            return Err(CpcaError::AdaptiveGoesOn);
        }
        Grown::Vectors => {
            let compression = grow(SimdLevel::widest(), signal, options, Some(limit), observe)?;
            (compression.clustering.squared_error(signal), compression)
        }
        Grown::Clusters => {
            options.start_points(signal)?;
            let mut with = |clusters: usize| {
                let compression = compress(signal, &first_clusters(options, clusters), &mut observe)?;
                Ok((compression.clustering.squared_error(signal), compression))
            };
            fewest(options.clusters, limit, &mut with)?
        }
    };
    if error <= limit {
        return Ok(compression);
    }
    let (clusters, vectors) = (options.clusters, options.vectors);
    Err(CpcaError::NotMet { expected: share, found: error / signal.sum_of_squares(), clusters, vectors })
}

/// The same options for fewer clusters.
fn first_clusters(options: &CpcaOptions, clusters: usize) -> CpcaOptions {
    let start = match &options.start {
        StartPoints::Seed(seed) => StartPoints::Seed(*seed),
        StartPoints::Given(points) => StartPoints::Given(points[..clusters].to_vec()),
    };
    CpcaOptions { clusters, start, ..options.clone() }
}

/// A number of clusters that meets the limit while one less does not; with `most` if none of those tried does.
fn fewest<T>(
    most: usize,
    limit: f64,
    with: &mut impl FnMut(usize) -> Result<(f64, T), CpcaError>,
) -> Result<(f64, T), CpcaError> {
    let (mut missed, mut clusters) = (0, 1);
    let mut met = with(clusters)?;
    while met.0 > limit && clusters < most {
        missed = clusters;
        clusters = (2 * clusters).min(most);
        met = with(clusters)?;
    }
    while met.0 <= limit && clusters - missed > 1 {
        let middle = missed + (clusters - missed) / 2;
        let found = with(middle)?;
        if found.0 <= limit {
            (clusters, met) = (middle, found);
        } else {
            missed = middle;
        }
    }
    Ok(met)
}
