//! What is drawn, by which card.

use miette::Diagnostic;
use refsim::device::{DeviceError, Profile};
use refsim::machine::Executor;
use refsim::texture::TexelFormat;
use thiserror::Error;

use crate::card::MeshError;
use crate::card::frame_time::FrameTimeError;
use crate::cpca::coherence::Superclusters;
use crate::cpca::on_card::{CompressedTransfer, PrtCardError, PrtCardOptions};
use crate::geom::Mesh;
use crate::picture::PictureError;
use crate::scene::Camera;
use crate::sphere::{HarmonicLight, HemisphereError};
use crate::study::timeline_trace::TimelineError;
use crate::transfer::Vertices;
use crate::transfer::brdf::ExitBasis;
use crate::transfer::clustering::Clustering;
use crate::transfer::file::PrtMeaning;

/// A model with compressed transfer, a light and a camera, and the card that draws it.
#[derive(Debug)]
pub struct OnCard {
    /// The model's name.
    pub model: String,
    /// Its mesh.
    pub mesh: Mesh,
    /// Its vertices, the points of the clusters.
    pub vertices: Vertices,
    /// What the numbers of a vertex mean.
    pub meaning: PrtMeaning,
    /// The clusters.
    pub clustering: Clustering,
    /// Their superclusters, if the file has some.
    pub superclusters: Option<Superclusters>,
    /// The light's name.
    pub light_name: String,
    /// The light, of the order of the transfer.
    pub light: HarmonicLight,
    /// The camera.
    pub camera: Camera,
    /// What radiance is multiplied by; `None` for auto-exposure: 18 % grey on average.
    pub exposure: Option<f64>,
    /// The card.
    pub profile: Profile,
    /// Its switches that were set.
    pub switches: Vec<(String, String)>,
    /// What runs its programs.
    pub executor: Executor,
    /// The picture's format.
    pub format: TexelFormat,
    /// Variants.
    pub options: PrtCardOptions,
    /// Whether one thing after the other is made coarse.
    pub sweep: bool,
}

/// Why there is no picture.
#[non_exhaustive]
#[derive(Debug, Error, Diagnostic)]
pub enum CardError {
    /// A signal that is no transfer.
    #[error("expected transfer, found numbers without a meaning")]
    #[diagnostic(code(crossbar::prt::meaning), help("compress a file that `crossbar cpca precompute` wrote"))]
    NoTransfer,
    /// A device of the sweep is not known.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Device(#[from] DeviceError),
    /// The card refuses.
    #[error(transparent)]
    #[diagnostic(
        code(crossbar::prt::card),
        help("`crossbar cpca render` draws on the host what no card takes; `crossbar devices` lists cards")
    )]
    Card(#[from] PrtCardError),
    /// What pixels show cannot be found.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::card))]
    Seen(#[from] MeshError),
    /// The functions of exit radiance are none.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::functions))]
    Functions(#[from] HemisphereError),
    /// The frame has no time.
    #[error(transparent)]
    #[diagnostic(code(crossbar::prt::time))]
    Time(#[from] FrameTimeError),
    /// The frame has no timeline.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Timeline(#[from] TimelineError),
    /// A picture that cannot be shown.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
}

impl OnCard {
    pub(super) fn basis(&self) -> Result<ExitBasis, CardError> {
        let PrtMeaning::Transfer { exit_functions, .. } = &self.meaning else { return Err(CardError::NoTransfer) };
        Ok(ExitBasis::of_functions(exit_functions)?)
    }

    pub(super) fn transfer<'a>(&'a self, basis: &'a ExitBasis) -> Result<CompressedTransfer<'a>, CardError> {
        let PrtMeaning::Transfer { channels, .. } = &self.meaning else { return Err(CardError::NoTransfer) };
        let vectors = self.clustering.subspaces().iter().map(|subspace| subspace.len()).max().unwrap_or(0);
        let Self { vertices, clustering, superclusters, .. } = self;
        let (channels, superclusters) = (*channels as usize, superclusters.as_ref());
        Ok(CompressedTransfer { vertices, clustering, basis, channels, vectors, superclusters })
    }
}
