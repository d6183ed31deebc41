//! Clustered principal components: glossy transfer with shadows, drawn by the card.

use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;

use super::run::{SystemInput, SystemRun, bunny, cameras};
use crate::card::MeshView;
use crate::cpca::on_card::PrtCardOptions;
use crate::scene::Camera;
use crate::sphere::HarmonicLight;
use crate::study::StudyError;
use crate::study::caster::CasterChoice;
use crate::study::glossy_model::{GlossyModel, GlossyTransfer};
use crate::transfer::brdf::Brdf;
use crate::transfer::{Tangents, Vertices};

/// Light of 9 coefficients, exit radiance of 16, and a broad specular lobe.
const TRANSFER: GlossyTransfer = GlossyTransfer {
    brdf: Brdf::Phong { albedo: 0.4, specular: 0.4, exponent: 8.0 },
    order: 3,
    exit_order: 4,
    clusters: 6,
    vectors: 6,
    iterations: 4,
};

/// Glossy bunny that shadows itself.
#[derive(Debug)]
pub(super) struct GlossyBunny {
    model: GlossyModel,
    light: HarmonicLight,
    cameras: [Camera; 2],
}

impl GlossyBunny {
    pub(super) fn new() -> Result<Self, StudyError> {
        let mesh = bunny();
        let vertices = Vertices::new(&mesh, Tangents::Any)?;
        let (transfer, _) = TRANSFER.precompute((&mesh, &vertices), &CasterChoice::Host, &mut |_, _, _| ())?;
        let (model, light) = (TRANSFER.model(vertices, transfer), HarmonicLight::red_and_blue(TRANSFER.order));
        Ok(Self { model, light, cameras: cameras(&mesh) })
    }
}

impl SystemRun for GlossyBunny {
    fn title(&self) -> &'static str {
        "Clustered principal components: a glossy bunny"
    }

    fn values(&self, input: SystemInput, profile: &Profile, executor: &Executor) -> Result<Vec<[f64; 3]>, StudyError> {
        // The paper's card sums clusters by blending, which it cannot do with floats.
        let view = MeshView { camera: self.cameras[input as usize], exposure: 0.8, format: TexelFormat::Bgra8 };
        let colors = self.model.draw(&self.light, (profile, executor), &view, &PrtCardOptions::default())?;
        // The 8-bit codes, which were read in single precision.
        Ok(colors.into_iter().map(|color| color.map(|value| (255.0 * value).round() / 255.0)).collect())
    }
}
