//! The drawn object: a mesh with compressed transfer.

use crate::card::CardError;
use crate::clustering::Clustering;
use crate::sphere::order_with;
use crate::transfer::Vertices;
use crate::transfer::brdf::ExitBasis;

use super::model::TransferSize;

/// The compressed transfer of a mesh's vertices: one matrix per channel, row by row, from light in global coordinates
/// to exit radiance in local coordinates.
#[derive(Clone, Copy, Debug)]
pub struct CompressedTransfer<'a> {
    /// The mesh.
    pub vertices: &'a Vertices,
    /// The clusters, with one point per vertex.
    pub clustering: &'a Clustering,
    /// The basis of the rows; [`ExitBasis::Radiance`] for diffuse transfer.
    pub basis: &'a ExitBasis,
    /// Number of matrices per vertex: 1 for all channels, or 3.
    pub channels: usize,
    /// The number n' of vectors per cluster. A cluster of lower rank may have fewer.
    pub vectors: usize,
}

impl CompressedTransfer<'_> {
    /// True if exit radiance depends on the view.
    pub fn is_glossy(&self) -> bool {
        matches!(self.basis, ExitBasis::Harmonics(_))
    }

    /// Number of means and vectors of all clusters.
    pub fn representatives(&self) -> usize {
        self.clustering.subspaces().iter().map(|subspace| subspace.len() + 1).sum()
    }

    /// The sizes of the transfer. Fails with [`CardError`] if its parts are inconsistent.
    pub fn size(&self) -> Result<TransferSize, CardError> {
        let (channels, rows, found) = (self.channels, self.basis.len(), self.clustering.dimension());
        let size = channels * rows;
        let columns = found.checked_div(size).unwrap_or(0);
        if ![1, 3].contains(&channels) || size * columns != found || order_with(columns).is_none() {
            return Err(CardError::input(format!(
                "expected {channels} x {rows} x n^2 numbers per vertex for light of an order n of 1 to 10, found \
                 {found}; channels are 1 or 3"
            )));
        }
        CardError::check_size("points, one per vertex", self.vertices.len(), self.clustering.points())?;
        let lens = self.clustering.subspaces().iter().map(|subspace| subspace.len());
        match lens.enumerate().find(|&(_, found)| found > self.vectors) {
            Some((cluster, found)) => Err(CardError::input(format!(
                "cluster {cluster} has {found} vectors, expected at most {}: the programs have no loops that depend \
                 on data, so clusters of adaptive size are evaluated on the host alone",
                self.vectors
            ))),
            None => {
                let (vertices, clusters) = (self.vertices.len(), self.clustering.subspaces().len());
                Ok(TransferSize { vertices, rows, columns, clusters, vectors: self.vectors })
            }
        }
    }
}
