//! Signals and clusterings that several entries share, by their index in [`SIGNALS`]; costs of models.

use super::drawn::DrawnClusters;
use super::mesh_cost::MeshCost;
use super::signals::{ComputedSignal, SIGNALS};
use super::{Shared, StudyError};
use crate::clustering::{Clustering, CpcaMethod};
use crate::scene::built::transfer_models::TransferModel;
use crate::study::reproduce::shared::SharedResult;

impl SharedResult for ComputedSignal {
    type Key = usize;

    fn compute(&at: &usize, shared: &Shared) -> Result<Self, StudyError> {
        Self::new(&SIGNALS[at], shared.models)
    }
}

/// Iterative clustering with the printed numbers of clusters and vectors; reduced models have a fraction of the
/// clusters.
struct IterativeClustering(Clustering);

impl SharedResult for IterativeClustering {
    type Key = usize;

    fn compute(&at: &usize, shared: &Shared) -> Result<Self, StudyError> {
        let size = SIGNALS[at].size;
        let signal = shared.get::<ComputedSignal>(at)?;
        signal.compressed(size.clusters, size.vectors, CpcaMethod::Iterative).map(Self)
    }
}

/// Returns a signal with its iterative clustering.
pub(super) fn iterative(shared: &Shared, at: usize) -> Result<(&ComputedSignal, &Clustering), StudyError> {
    Ok((shared.get(at)?, &shared.get::<IterativeClustering>(at)?.0))
}

/// Drawing cost of the iterative clustering.
impl SharedResult for DrawnClusters {
    type Key = usize;

    fn compute(&at: &usize, shared: &Shared) -> Result<Self, StudyError> {
        let (signal, clustering) = iterative(shared, at)?;
        Self::new(signal, clustering)
    }
}

/// Drawing cost of our model at the printed size.
impl SharedResult for MeshCost {
    type Key = TransferModel;

    fn compute(model: &TransferModel, _: &Shared) -> Result<Self, StudyError> {
        Self::new(&model.mesh(1))
    }
}
