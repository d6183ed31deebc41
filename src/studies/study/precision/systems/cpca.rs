//! Clustered principal components: glossy transfer with shadows, drawn by the card.

use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;

use super::run::{SystemInput, SystemRun, bunny, cameras};
use crate::card::MeshView;
use crate::clustering::{Clustering, CpcaForm, CpcaMethod, CpcaOptions, StartPoints, compress};
use crate::cpca::on_card::{CompressedTransfer, PrtCard, PrtCardOptions};
use crate::cpca::transfer::{Bounces, Incident};
use crate::scene::Camera;
use crate::sphere::HarmonicLight;
use crate::study::StudyError;
use crate::study::prt::{ExitRadiance, Precomputation, no_cpca_card};
use crate::transfer::brdf::{Brdf, ExitBasis};
use crate::transfer::{Tangents, Vertices};

/// Order of the light: 9 coefficients.
const ORDER: usize = 3;
/// Exit functions: harmonics up to this order.
const EXIT_ORDER: usize = 4;
/// Clusters, and their vectors besides the mean.
const CLUSTERS: usize = 6;
const VECTORS: usize = 6;
/// Exponent of the Phong lobe.
const EXPONENT: f64 = 8.0;

/// Glossy bunny that shadows itself.
#[derive(Debug)]
pub(super) struct GlossyBunny {
    vertices: Vertices,
    clustering: Clustering,
    basis: ExitBasis,
    light: HarmonicLight,
    cameras: [Camera; 2],
}

impl GlossyBunny {
    pub(super) fn new() -> Result<Self, StudyError> {
        let mesh = bunny();
        let vertices = Vertices::new(&mesh, Tangents::Any)?;
        let basis = ExitBasis::of_order(EXIT_ORDER);
        let brdf = Brdf::Phong { albedo: 0.4, specular: 0.4, exponent: EXPONENT };
        let exit = ExitRadiance::Glossy { basis: basis.clone(), least_squares: true, incident: Incident::Directions };
        let transfer = Precomputation {
            mesh: &mesh,
            vertices: &vertices,
            channels: vec![(0, vec![brdf])],
            exit,
            order: ORDER,
            degree: 24,
            bounces: Bounces::Count(0),
            scatterer: None,
        };
        let file = transfer.run(&mut |_, _, _| ())?.file;
        let signal = file.transfer.expect("transfer that was computed");
        let options = CpcaOptions {
            clusters: CLUSTERS,
            vectors: VECTORS,
            vq_iterations: 4,
            iterations: 4,
            method: CpcaMethod::Iterative,
            form: CpcaForm::Affine,
            start: StartPoints::Seed(1),
        };
        let clustering = compress(&signal, &options, |_| ()).expect("fewer clusters than vertices").clustering;
        Ok(Self { vertices, clustering, basis, light: HarmonicLight::red_and_blue(ORDER), cameras: cameras(&mesh) })
    }
}

impl SystemRun for GlossyBunny {
    fn title(&self) -> &'static str {
        "Clustered principal components: a glossy bunny"
    }

    fn values(&self, input: SystemInput, profile: &Profile, executor: &Executor) -> Result<Vec<[f64; 3]>, StudyError> {
        let Self { vertices, clustering, basis, .. } = self;
        let transfer =
            CompressedTransfer { vertices, clustering, basis, channels: 1, vectors: VECTORS, superclusters: None };
        let options = PrtCardOptions::default();
        let card = PrtCard::new(profile.clone(), executor.clone(), transfer, &options);
        // The paper's card adds clusters up by blending, which it cannot do with floats.
        let view = MeshView { camera: self.cameras[input as usize], exposure: 0.8, format: TexelFormat::Bgra8 };
        let texels = card.and_then(|mut card| card.view_texels(&self.light, &view)).map_err(no_cpca_card)?;
        // Codes of 8 bits, which were read in single precision.
        Ok(texels.colors().into_iter().map(|color| color.map(|value| (255.0 * value).round() / 255.0)).collect())
    }
}
