//! A model with compressed transfer, with a light and a camera.

use crate::clustering::Clustering;
use crate::cpca::on_card::{CompressedTransfer, PrtCardOptions};
use crate::sphere::HarmonicLight;
use crate::study::StudyError;
use crate::study::prt::LitView;
use crate::study::prt::card::CardSetting;
use crate::study::prt::exit_radiance::no_transfer;
use crate::transfer::Vertices;
use crate::transfer::brdf::ExitBasis;
use crate::transfer::file::PrtMeaning;

/// A model with compressed transfer, a light and a camera, and the card that draws it.
#[derive(Debug)]
pub struct OnCard {
    /// Names, camera and exposure.
    pub view: LitView,
    /// The model's vertices, which are the points of the clusters.
    pub vertices: Vertices,
    /// Meaning of the numbers at a vertex.
    pub meaning: PrtMeaning,
    /// Clusters of the compressed transfer.
    pub clustering: Clustering,
    /// The light, with the same order as the transfer.
    pub light: HarmonicLight,
    /// The card that draws.
    pub card: CardSetting,
    /// Drawing options: superclusters, maps, format of weights.
    pub options: PrtCardOptions,
}

impl OnCard {
    pub(super) fn basis(&self) -> Result<ExitBasis, StudyError> {
        let PrtMeaning::Transfer { exit_functions, .. } = &self.meaning else {
            return Err(no_transfer());
        };
        Ok(ExitBasis::of_functions(exit_functions)?)
    }

    pub(super) fn transfer<'a>(&'a self, basis: &'a ExitBasis) -> Result<CompressedTransfer<'a>, StudyError> {
        let PrtMeaning::Transfer { channels, .. } = &self.meaning else { return Err(no_transfer()) };
        let vectors = self.clustering.subspaces().iter().map(|subspace| subspace.len()).max().unwrap_or(0);
        let Self { vertices, clustering, .. } = self;
        Ok(CompressedTransfer { vertices, clustering, basis, channels: *channels as usize, vectors })
    }
}
