//! Clustered principal components: glossy transfer with shadows, drawn by the card.

use refsim::texture::TexelFormat;

use super::subject::{System, bunny, cameras};
use crate::card::MeshView;
use crate::cpca::on_card::PrtCardOptions;
use crate::sphere::HarmonicLight;
use crate::study::StudyError;
use crate::study::caster::CasterChoice;
use crate::study::glossy_model::GlossyTransfer;
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
pub(super) fn glossy_bunny() -> Result<System, StudyError> {
    let mesh = bunny();
    let (vertices, cameras) = (Vertices::new(&mesh, Tangents::Any)?, cameras(&mesh));
    let (transfer, _) = TRANSFER.precompute((&mesh, &vertices), &CasterChoice::Host, &mut |_, _, _| ())?;
    let (model, light) = (TRANSFER.model(vertices, transfer), HarmonicLight::red_and_blue(TRANSFER.order));
    Ok(System::picture("Clustered principal components: a glossy bunny", move |input, profile, executor| {
        // The paper's card sums clusters by blending, which it cannot do with floats.
        let view = MeshView { camera: cameras[input], exposure: 0.8, format: TexelFormat::Bgra8 };
        let (colors, _) = model.draw(&light, (profile, executor), &view, &PrtCardOptions::default())?;
        // The 8-bit codes, which were read in single precision.
        Ok(colors.into_iter().map(|color| color.map(|value| (255.0 * value).round() / 255.0)).collect())
    }))
}
