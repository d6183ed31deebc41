//! A glossy model, compressed by clustered principal components and drawn by a card: a small input for studies.

use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::timing::Picoseconds;

use crate::card::MeshView;
use crate::card::frame_time::{FrameTimeError, frame_time};
use crate::clustering::{Clustering, CpcaForm, CpcaMethod, CpcaOptions, compress};
use crate::cpca::on_card::time::host_of_section_7;
use crate::cpca::on_card::{CompressedTransfer, PrtCard, PrtCardOptions};
use crate::cpca::transfer::Incident;
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::sphere::HarmonicLight;
use crate::study::caster::{CastRecord, CasterChoice};
use crate::study::prt::{ExitRadiance, Precomputation, Precomputed, no_cpca_card};
use crate::study::{ProgressFn, StudyError};
use crate::transfer::Vertices;
use crate::transfer::brdf::{Brdf, ExitBasis};

/// Pixel colors, and the modelled time of the frame (`None` for cards without rates).
pub(super) type Drawn = (Vec<[f64; 3]>, Option<Picoseconds>);

/// Parameters of a model's transfer and of its compression.
#[derive(Clone, Copy, Debug)]
pub(super) struct GlossyTransfer {
    pub(super) brdf: Brdf,
    /// Orders of light and of exit radiance.
    pub(super) order: usize,
    pub(super) exit_order: usize,
    /// Number of clusters, and of vectors per cluster in addition to the mean.
    pub(super) clusters: usize,
    pub(super) vectors: usize,
    /// Iterations of the clustering, for each number of vectors.
    pub(super) iterations: usize,
}

impl GlossyTransfer {
    /// Computes the transfer with a ray caster, without compression.
    pub(super) fn precompute(
        &self,
        (mesh, vertices): (&Mesh, &Vertices),
        caster: &CasterChoice,
        progress: &mut ProgressFn<'_>,
    ) -> Result<(Precomputed, Option<CastRecord>), StudyError> {
        let (basis, incident) = (ExitBasis::of_order(self.exit_order), Incident::Directions);
        let precomputation = Precomputation {
            mesh,
            vertices,
            channels: vec![(0, vec![self.brdf])],
            exit: ExitRadiance::Glossy { basis, least_squares: true, incident },
            order: self.order,
            degree: 24,
            bounces: 0,
            scatterer: None,
        };
        let mut open = caster.open_judged(mesh, Sides::Both)?;
        let found = precomputation.run_by(&mut open, progress)?;
        Ok((found, open.record()))
    }

    /// Builds the model with its transfer compressed.
    pub(super) fn model(&self, vertices: Vertices, transfer: Precomputed) -> GlossyModel {
        let signal = transfer.file.transfer.expect("transfer that was computed");
        let options = CpcaOptions {
            clusters: self.clusters.min(vertices.len() / 4),
            vectors: self.vectors,
            vq_iterations: self.iterations,
            iterations: self.iterations,
            method: CpcaMethod::Iterative,
            form: CpcaForm::Affine,
            seed: 1,
        };
        let clustering = compress(&signal, &options, |_| ()).expect("fewer clusters than vertices").clustering;
        GlossyModel { vertices, clustering, basis: ExitBasis::of_order(self.exit_order), vectors: self.vectors }
    }
}

/// A glossy model, ready to be drawn.
#[derive(Debug)]
pub(super) struct GlossyModel {
    vertices: Vertices,
    clustering: Clustering,
    basis: ExitBasis,
    vectors: usize,
}

impl GlossyModel {
    /// Draws the model.
    pub(super) fn draw(
        &self,
        light: &HarmonicLight,
        (profile, executor): (&Profile, &Executor),
        view: &MeshView,
        options: &PrtCardOptions,
    ) -> Result<Drawn, StudyError> {
        let Self { vertices, clustering, basis, vectors } = self;
        let transfer = CompressedTransfer { vertices, clustering, basis, channels: 1, vectors: *vectors };
        let card = PrtCard::new(profile.clone(), executor.clone(), transfer, options);
        let (texels, log) = card.and_then(|mut card| card.logged_view(light, view)).map_err(no_cpca_card)?;
        let host = host_of_section_7().map_err(FrameTimeError::from)?;
        Ok((texels.colors(), frame_time(profile, &log, &host).ok().map(|time| time.frame)))
    }
}
