//! Signals and clusterings shared by several entries.

use std::cell::OnceCell;

use super::drawn::DrawnClusters;
use super::mesh_cost::MeshCost;
use super::signals::{ComputedSignal, SIGNALS};
use super::{ModelSize, ReproduceError};
use crate::scene::built::transfer_models::TransferModel;
use crate::study::reproduce::once::get_or_try;
use crate::transfer::clustering::{Clustering, CpcaMethod};

/// Signals by their index in [`SIGNALS`], with the results of Table 1.
#[derive(Default)]
pub(in crate::study::reproduce) struct CpcaShared {
    signals: [OnceCell<ComputedSignal>; SIGNALS.len()],
    clusterings: [OnceCell<Clustering>; SIGNALS.len()],
    drawn: [OnceCell<DrawnClusters>; SIGNALS.len()],
    mesh_costs: [OnceCell<MeshCost>; MODELS.len()],
}

/// Models of [`SIGNALS`].
const MODELS: [TransferModel; 4] =
    [TransferModel::Bumpy, TransferModel::Smooth, TransferModel::Head, TransferModel::Polygons];

impl CpcaShared {
    /// Returns a signal.
    pub(super) fn signal(&self, at: usize, models: ModelSize) -> Result<&ComputedSignal, ReproduceError> {
        get_or_try(&self.signals[at], || ComputedSignal::new(&SIGNALS[at], models))
    }

    /// Returns a signal with its iterative clustering, with the printed numbers of clusters and vectors, or a fraction
    /// of the clusters.
    pub(super) fn iterative(
        &self,
        at: usize,
        models: ModelSize,
    ) -> Result<(&ComputedSignal, &Clustering), ReproduceError> {
        let (signal, size) = (self.signal(at, models)?, SIGNALS[at].size);
        let compress = || signal.compressed(size.clusters, size.vectors, CpcaMethod::Iterative);
        Ok((signal, get_or_try(&self.clusterings[at], compress)?))
    }

    /// Returns the drawing cost of that clustering.
    pub(super) fn drawn(&self, at: usize, models: ModelSize) -> Result<&DrawnClusters, ReproduceError> {
        let (signal, clustering) = self.iterative(at, models)?;
        get_or_try(&self.drawn[at], || DrawnClusters::new(signal, clustering))
    }

    /// Returns the cost of a model on the card.
    pub(super) fn mesh_cost(&self, model: TransferModel) -> Result<MeshCost, ReproduceError> {
        match MODELS.iter().position(|&known| known == model) {
            Some(at) => get_or_try(&self.mesh_costs[at], || MeshCost::new(model)).copied(),
            None => MeshCost::new(model),
        }
    }
}
