//! A marble model with subsurface scattering, drawn by a card: a small input for studies.

use refsim::device::Profile;
use refsim::machine::Executor;

use super::glossy_model::Drawn;
use crate::atlas::Atlas;
use crate::card::{CardError, MeshView};
use crate::study::StudyError;
use crate::study::subsurface::no_card;
use crate::subsurface::links::{LinkChoice, Links, MeanWeighting, SCALAR_CHANNEL};
use crate::subsurface::multipole::SurfaceMoments;
use crate::subsurface::on_card::{
    CardModel, FloatTexels, LinkTextures, MapFormat, SubsurfaceCard, SubsurfaceCardOptions, View, pass_times,
};
use crate::subsurface::{Dipole, materials};

/// Maximum relative error of link factors.
const TOLERANCE: f64 = 0.05;

/// A marble model, ready to be lit and drawn.
pub(super) struct MarbleModel {
    model: CardModel,
    textures: LinkTextures,
    /// Index of refraction.
    pub(super) eta: f64,
}

impl MarbleModel {
    /// Builds the model over an atlas. `rgb` computes a link factor per color channel; otherwise, green's factor serves
    /// all.
    pub(super) fn new(atlas: &Atlas, mm_per_unit: f64, choice: LinkChoice, rgb: bool) -> Result<Self, StudyError> {
        let material = materials::named("marble").expect("a published medium").material();
        let [red, green, blue] = material.channels;
        let dipole = |channel| Dipole::new(channel, material.eta);
        let dipoles = [dipole(red)?, dipole(green)?, dipole(blue)?];
        let surface = SurfaceMoments::new(atlas, mm_per_unit)?;
        let of_links = if rgb { &dipoles[..] } else { &dipoles[SCALAR_CHANNEL..=SCALAR_CHANNEL] };
        let links = Links::new(&surface, of_links, choice, TOLERANCE)?;
        let textures = LinkTextures::new(&links, &surface, MeanWeighting::Area);
        Ok(Self { model: CardModel::new(atlas), textures, eta: material.eta })
    }

    /// Colors of pixels under light, with textures of these floats.
    pub(super) fn draw(
        &self,
        light: impl FnOnce(&mut SubsurfaceCard) -> Result<(), CardError>,
        (profile, executor): (&Profile, &Executor),
        view: MeshView,
        texels: FloatTexels,
    ) -> Result<Drawn, StudyError> {
        let map = if texels == FloatTexels::Fp32 { MapFormat::Fp32 } else { MapFormat::Fp16 };
        let options =
            SubsurfaceCardOptions { map, links: texels, scattered: texels, ..SubsurfaceCardOptions::default() };
        let (model, executor) = (self.model.clone(), executor.clone());
        let card = SubsurfaceCard::new(profile.clone(), executor, model, &self.textures, self.eta, options);
        let mut card = card.map_err(no_card)?;
        card.record(true);
        light(&mut card).map_err(no_card)?;
        let colors = card.view_texels(&View::scattered(view)).map_err(no_card)?.colors();
        let times = pass_times(profile, &card.take_log()).ok();
        Ok((colors, times.map(|times| times.iter().map(|pass| pass.time).sum())))
    }
}
