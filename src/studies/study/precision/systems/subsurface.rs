//! Subsurface scattering: light, gather and view on the card, on a bunny of marble.

use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;

use super::run::{SystemInput, SystemRun, bunny, cameras};
use crate::atlas::Atlas;
use crate::card::MeshView;
use crate::scene::Camera;
use crate::study::StudyError;
use crate::study::marble_model::MarbleModel;
use crate::study::subsurface::no_atlas;
use crate::subsurface::links::LinkChoice;
use crate::subsurface::on_card::{FloatTexels, Light};

/// Texels along a side of the atlas.
const SIDE: u32 = 32;
/// Clusters per texel.
const LINKS: usize = 16;
/// Millimeters of a unit of the model.
const SCALE: f64 = 10.0;

/// Bunny of marble, lit from one side.
#[derive(Debug)]
pub(super) struct Marble {
    model: MarbleModel,
    cameras: [Camera; 2],
}

impl Marble {
    pub(super) fn new() -> Result<Self, StudyError> {
        let (mesh, choice) = (bunny(), LinkChoice::Adaptive { count: LINKS });
        let model = MarbleModel::new(&Atlas::new(&mesh, SIDE).map_err(no_atlas)?, SCALE, choice, false)?;
        Ok(Self { model, cameras: cameras(&mesh) })
    }
}

impl SystemRun for Marble {
    fn title(&self) -> &'static str {
        "Subsurface scattering: a bunny of marble"
    }

    fn values(&self, input: SystemInput, profile: &Profile, executor: &Executor) -> Result<Vec<[f64; 3]>, StudyError> {
        let light = Light::Directional { towards: [1.0, -1.0, 2.0], irradiance: [4.0, 3.8, 3.4] };
        let view = MeshView { camera: self.cameras[input as usize], exposure: 1.0, format: TexelFormat::Rgba32f };
        Ok(self.model.draw(|card| card.light(&[light]), (profile, executor), view, FloatTexels::Fp32)?.0)
    }
}
