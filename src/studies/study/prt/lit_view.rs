//! The view of a lit model, shared by the pictures of all transfer systems.

use glam::DVec3;
use serde_json::json;

use super::interpolate::linear_picture;
use super::light_picture::light_picture;
use crate::error::InputError;
use crate::picture::Picture;
use crate::report::digits::{Quantity, shown};
use crate::report::{Findings, NamedPicture, false_color};
use crate::scene::Camera;

/// Mean value of the non-black pixels under auto-exposure.
const MIDDLE_GREY: f64 = 0.18;

/// A model under a light, seen by a camera.
#[derive(Debug)]
pub struct LitView {
    /// The model's name.
    pub model: String,
    /// The light's name.
    pub light: String,
    /// The camera.
    pub camera: Camera,
    /// Factor for radiance; `None` for auto-exposure: 18 % grey on average.
    pub exposure: Option<f64>,
}

impl LitView {
    /// Returns the exposure for linear radiance of pixels.
    pub(super) fn exposure_of(&self, linear: &[[f64; 3]]) -> f64 {
        self.exposure.unwrap_or_else(|| auto_exposure(linear))
    }

    pub(super) fn caption(&self) -> String {
        format!("{} under {}", self.model, self.light)
    }

    /// The pixels of the camera as a picture.
    pub(super) fn picture(&self, colors: &[[f64; 3]]) -> Picture {
        linear_picture(&self.camera, colors)
    }

    /// Picture of the light, from its radiance by direction.
    pub(super) fn light_picture(
        &self,
        radiance: impl Fn(DVec3) -> [f64; 3] + Sync,
    ) -> Result<NamedPicture, InputError> {
        light_picture("light", &self.light, radiance)
    }

    /// Findings that begin with a drawn picture and a picture of its light; returns the exposure too.
    pub(super) fn findings(
        &self,
        title: &str,
        drawn: &[[f64; 3]],
        radiance: impl Fn(DVec3) -> [f64; 3] + Sync,
    ) -> Result<(Findings, f64), InputError> {
        let exposure = self.exposure_of(drawn);
        let mut found = Findings::new(title);
        found.taken_from(self.camera.world_to_camera());
        let picture = self.picture(drawn);
        let shown = NamedPicture::new("picture", picture.display(exposure)?, self.caption());
        found.pictures(vec![shown, self.light_picture(radiance)?]);
        found.keep_layers("picture", picture);
        found.field("exposure", json!(exposure));
        Ok((found, exposure))
    }

    /// Adds the picture from uncompressed transfer, and the difference of `drawn` from it, named by `less`. Returns the
    /// difference of each pixel's mean channel, and the largest.
    pub(super) fn against_original(
        &self,
        drawn: &[[f64; 3]],
        original: &[[f64; 3]],
        exposure: f64,
        less: &str,
    ) -> Result<(Vec<NamedPicture>, Vec<f64>, f64), InputError> {
        let mean = |color: &[f64; 3]| color.iter().sum::<f64>() / 3.0;
        let difference: Vec<f64> = drawn.iter().zip(original).map(|(a, b)| mean(a) - mean(b)).collect();
        let largest = difference.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let shown_original = self.picture(original).display(exposure)?;
        let mut pictures = vec![NamedPicture::new("original", shown_original, "without compression")];
        if largest > 0.0 {
            let caption = format!("{less}: blue -{0}, white 0, red +{0}", shown(largest, Quantity::Measured));
            let image = false_color::signed(self.camera.width(), &difference, largest);
            pictures.push(NamedPicture::new("difference", image, caption));
        }
        Ok((pictures, difference, largest))
    }

    /// Sentence about the number of pixels that show the model.
    pub(super) fn sentence(&self, shown: usize) -> String {
        let pixels = u64::from(self.camera.width()) * u64::from(self.camera.height());
        format!("{shown} of {pixels} pixels show {}.", self.caption())
    }
}

/// Exposure that makes visible pixels 18 % grey on average.
pub(in crate::study) fn auto_exposure(colors: &[[f64; 3]]) -> f64 {
    let lit: Vec<f64> =
        colors.iter().map(|color| color.iter().sum::<f64>() / 3.0).filter(|&value| value > 0.0).collect();
    let mean = lit.iter().sum::<f64>() / lit.len().max(1) as f64;
    if mean > 0.0 { MIDDLE_GREY / mean } else { 1.0 }
}
