//! Subsurface scattering: light, gather and view on the card, on a bunny of marble.

use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::texture::TexelFormat;

use super::run::{SystemInput, SystemRun, bunny, cameras};
use crate::atlas::Atlas;
use crate::card::MeshView;
use crate::scene::Camera;
use crate::study::StudyError;
use crate::study::subsurface::no_card;
use crate::subsurface::Dipole;
use crate::subsurface::links::{LinkChoice, Links, MeanWeighting, SCALAR_CHANNEL};
use crate::subsurface::materials;
use crate::subsurface::multipole::SurfaceMoments;
use crate::subsurface::on_card::{
    CardModel, FloatTexels, Light, LinkTextures, MapFormat, SubsurfaceCard, SubsurfaceCardOptions, View,
};

/// Texels along a side of the atlas.
const SIDE: u32 = 32;
/// Clusters per texel.
const LINKS: usize = 16;
/// Millimeters of a unit of the model.
const SCALE: f64 = 10.0;
/// Largest relative error of factors.
const TOLERANCE: f64 = 0.05;

/// Bunny of marble, lit from one side.
pub(super) struct Marble {
    model: CardModel,
    textures: LinkTextures,
    eta: f64,
    cameras: [Camera; 2],
}

impl std::fmt::Debug for Marble {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Marble").field("model", &self.model).finish_non_exhaustive()
    }
}

impl Marble {
    pub(super) fn new() -> Result<Self, StudyError> {
        let mesh = bunny();
        let material = materials::named("marble").expect("a published medium").material();
        let [_, green, _] = material.channels;
        let dipole = Dipole::new(green, material.eta)?;
        let atlas = Atlas::new(&mesh, SIDE).expect("room for each face");
        let surface = SurfaceMoments::new(&atlas, SCALE)?;
        let dipoles = [dipole; SCALAR_CHANNEL + 1];
        let choice = LinkChoice::Adaptive { count: LINKS };
        let links = Links::new(&surface, &dipoles[SCALAR_CHANNEL..], choice, TOLERANCE, &|_, _| {})?;
        let textures = LinkTextures::new(&links, &surface, MeanWeighting::Area);
        Ok(Self { model: CardModel::new(&atlas), textures, eta: material.eta, cameras: cameras(&mesh) })
    }
}

impl SystemRun for Marble {
    fn title(&self) -> &'static str {
        "Subsurface scattering: a bunny of marble"
    }

    fn values(&self, input: SystemInput, profile: &Profile, executor: &Executor) -> Result<Vec<[f64; 3]>, StudyError> {
        let options = SubsurfaceCardOptions {
            map: MapFormat::Fp32,
            links: FloatTexels::Fp32,
            scattered: FloatTexels::Fp32,
            ..SubsurfaceCardOptions::default()
        };
        let mut card = SubsurfaceCard::new(
            profile.clone(),
            executor.clone(),
            self.model.clone(),
            &self.textures,
            self.eta,
            options,
        )
        .map_err(no_card)?;
        let light = Light::Directional { towards: [1.0, -1.0, 2.0], irradiance: [4.0, 3.8, 3.4] };
        card.light(&[light]).map_err(no_card)?;
        let view = MeshView { camera: self.cameras[input as usize], exposure: 1.0, format: TexelFormat::Rgba32f };
        Ok(card.view_texels(&View::scattered(view)).map_err(no_card)?.colors())
    }
}
