//! Pictures drawn by the card, and computed by the host in f64.

use rayon::prelude::*;
use refsim::event::Event;
use refsim::texture::TexelFormat;

use super::subject::BiScaleOnCard;
use crate::bi_scale::on_card::{BiScaleCard, DisplayCounts, DisplayOptions, GatherCard, GatherCounts, LightFormat};
use crate::card::{MeshView, SeenPixel};
use crate::study::StudyError;

/// L~ as the card computes it, and its counts.
pub(super) struct CardLight {
    pub(super) local: Vec<[f32; 3]>,
    pub(super) counts: GatherCounts,
    pub(super) log: Vec<Event>,
}

/// A picture drawn by the card.
pub(super) struct Drawn {
    pub(super) pixels: Vec<[f64; 3]>,
    pub(super) counts: DisplayCounts,
    pub(super) log: Vec<Event>,
}

impl BiScaleOnCard {
    /// Algorithm 2 on the card.
    pub(super) fn local(&self, light: &[[f64; 3]], format: LightFormat) -> Result<CardLight, StudyError> {
        let singles: Vec<[f32; 3]> = light.iter().map(|texel| texel.map(|value| value as f32)).collect();
        let mut card =
            GatherCard::new(self.card.profile.clone(), self.card.executor.clone(), &self.biclusters, format)?;
        let (local, log) = card.logged_multiply(&singles)?;
        Ok(CardLight { local, counts: card.counts(), log })
    }

    /// Draws the display pass.
    pub(super) fn draw(
        &self,
        local: &[[f32; 3]],
        options: DisplayOptions,
        format: TexelFormat,
        exposure: f64,
    ) -> Result<Drawn, StudyError> {
        let mut card = BiScaleCard::new(self.card.profile.clone(), self.card.executor.clone(), self.mesh(), options)?;
        let view = MeshView { camera: self.view.camera, exposure, format };
        let (texels, log) = card.logged_view(local, &view)?;
        Ok(Drawn { pixels: texels.colors(), counts: card.counts(), log })
    }

    /// Equation 3 in f64, exposed, neither clamped nor quantised. Pixels without a surface are 0.
    pub(super) fn exact(&self, local: &[[f64; 3]], seen: &[Option<SeenPixel>], exposure: f64) -> Vec<[f64; 3]> {
        let (mesh, eye) = (self.mesh(), self.view.camera.eye());
        let of = |seen: &Option<SeenPixel>| {
            let color = seen.map_or([0.0; 3], |seen| mesh.pixel(local, eye, &seen));
            color.map(|value| exposure * value)
        };
        seen.par_iter().map(of).collect()
    }
}

/// Converts single to double precision.
pub(super) fn doubles(local: &[[f32; 3]]) -> Vec<[f64; 3]> {
    local.iter().map(|rgb| rgb.map(f64::from)).collect()
}
