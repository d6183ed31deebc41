//! Subspaces fitted again to the points that they have.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::fit::{Fitted, fit};
use super::gram::KeptProducts;
use super::members::Members;
use super::{Clustering, CpcaError};
use crate::transfer::Signal;

/// A clustering with the same points in each cluster and the principal components of these points, with as many vectors
/// as the cluster had. The squared error does not increase, except by rounding. The paper leaves open whether this
/// follows a reclassification.
///
/// # Errors
/// [`CpcaError::Factor`] if principal components cannot be computed.
///
/// # Panics
/// If the signal has another shape.
pub fn refit(signal: &Signal, clustering: &Clustering) -> Result<Clustering, CpcaError> {
    let shape = (clustering.points(), clustering.dimension());
    assert_eq!((signal.points(), signal.dimension()), shape, "the signal's shape");
    let (subspaces, of_point) = (clustering.subspaces(), clustering.of_point());
    let (members, level) = (Members::new(of_point, subspaces.len()), SimdLevel::widest());
    let form = clustering.form();
    let one = |cluster: usize| match members.of(cluster) {
        [] => Ok(Fitted::at(subspaces[cluster].mean.clone())),
        points => {
            let kept = &mut KeptProducts::default();
            fit(signal, points, subspaces[cluster].len(), form, level, kept).map_err(|source| (cluster, source))
        }
    };
    let fitted: Vec<_> = (0..subspaces.len()).into_par_iter().with_max_len(1).map(one).collect();
    let fitted = fitted.into_iter().map(|fitted| fitted.map(|fitted| fitted.subspace));
    let fitted = fitted.collect::<Result<_, _>>();
    let fitted = fitted.map_err(|(cluster, reason)| CpcaError::Factor { cluster, reason })?;
    Ok(Clustering::project(signal, fitted, of_point.to_vec()))
}
