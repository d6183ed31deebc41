//! Subsurface scattering: light, gather and view on the card, on a marble bunny.

use refsim::texture::TexelFormat;

use super::subject::{System, bunny, cameras};
use crate::atlas::Atlas;
use crate::card::MeshView;
use crate::study::StudyError;
use crate::study::marble_model::MarbleModel;
use crate::study::subsurface::no_atlas;
use crate::subsurface::links::LinkChoice;
use crate::subsurface::on_card::{FloatTexels, Light};

/// Number of texels per side of the atlas.
const SIDE: u32 = 32;
/// Clusters per texel.
const LINKS: usize = 16;
/// Millimeters per unit of the model.
const SCALE: f64 = 10.0;

/// Marble bunny, lit from one side.
pub(super) fn marble() -> Result<System, StudyError> {
    let (mesh, choice) = (bunny(), LinkChoice::Adaptive { count: LINKS });
    let model = MarbleModel::new(&Atlas::new(&mesh, SIDE).map_err(no_atlas)?, SCALE, choice, false)?;
    let cameras = cameras(&mesh);
    Ok(System::picture("Subsurface scattering: a marble bunny", move |input, profile, executor| {
        let light = Light::Directional { towards: [1.0, -1.0, 2.0], irradiance: [4.0, 3.8, 3.4] };
        let view = MeshView { camera: cameras[input], exposure: 1.0, format: TexelFormat::Rgba32f };
        Ok(model.draw(|card| card.light(&[light]), (profile, executor), view, FloatTexels::Fp32)?.0)
    }))
}
