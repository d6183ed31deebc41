//! The view of a lit model, and pictures of its light, shared by the pictures of all transfer systems.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use rayon::prelude::*;
use serde_json::json;

use crate::elementary::sin_cos;
use crate::error::InputError;
use crate::picture::Picture;
use crate::report::digits::{Quantity, shown};
use crate::report::{Findings, NamedPicture, false_color};
use crate::scene::Camera;
use crate::transfer::grid::{LIGHT_MAP, LIGHT_SIDE};

/// Linear value of the mean non-black pixel under auto-exposure, and of the median one in pictures of lights.
const MIDDLE_GREY: f64 = 0.18;
/// Width of the picture of a light in pixels, twice its height.
const LIGHT_WIDTH: u32 = 320;

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
    pub(super) fn exposure_of(&self, linear: &[[f64; 3]]) -> f64 {
        self.exposure.unwrap_or_else(|| auto_exposure(linear))
    }

    pub(super) fn caption(&self) -> String {
        format!("{} under {}", self.model, self.light)
    }

    pub(super) fn picture(&self, colors: &[[f64; 3]]) -> Picture {
        linear_picture(&self.camera, colors)
    }

    /// Findings that begin with a drawn picture, a picture of its light, and the sentence about the number of pixels
    /// that show the model; returns the exposure too.
    pub(super) fn findings(
        &self,
        title: &str,
        drawn: &[[f64; 3]],
        radiance: impl Fn(DVec3) -> [f64; 3] + Sync,
        seen: usize,
    ) -> Result<(Findings, f64), InputError> {
        let exposure = self.exposure_of(drawn);
        let mut found = Findings::new(title);
        found.taken_from(self.camera.world_to_camera());
        let picture = self.picture(drawn);
        let shown = NamedPicture::new("picture", picture.display(exposure)?, self.caption());
        found.pictures(vec![shown, light_picture("light", &self.light, radiance)?]);
        found.keep_layers("picture", picture);
        found.field("exposure", json!(exposure));
        let pixels = u64::from(self.camera.width()) * u64::from(self.camera.height());
        found.conclusion(format!("{seen} of {pixels} pixels show {}.", self.caption()));
        Ok((found, exposure))
    }

    /// Adds the picture from uncompressed transfer, and the difference of `drawn` from it, named by `minus`. Returns
    /// the difference of each pixel's mean channel, and the largest.
    pub(super) fn against_original(
        &self,
        drawn: &[[f64; 3]],
        original: &[[f64; 3]],
        exposure: f64,
        minus: &str,
    ) -> Result<(Vec<NamedPicture>, Vec<f64>, f64), InputError> {
        let (difference, largest) = difference_of_means(drawn, original);
        let shown_original = self.picture(original).display(exposure)?;
        let mut pictures = vec![NamedPicture::new("original", shown_original, "without compression")];
        if largest > 0.0 {
            pictures.push(signed_picture(
                "difference",
                &format!("{minus}:"),
                self.camera.width(),
                &difference,
                largest,
            ));
        }
        Ok((pictures, difference, largest))
    }
}

/// The root mean square of differences relative to that of `exact`, in percent; `None` if `exact` is 0.
pub(super) fn relative_rms(differences: impl Iterator<Item = f64>, exact: impl Iterator<Item = f64>) -> Option<f64> {
    let apart: f64 = differences.map(|value| value * value).sum();
    let whole: f64 = exact.map(|value| value * value).sum();
    (whole > 0.0).then(|| 100.0 * (apart / whole).sqrt())
}

pub(super) fn mean(color: &[f64; 3]) -> f64 {
    color.iter().sum::<f64>() / 3.0
}

/// Differences of the pixels' mean channels, and the largest.
pub(super) fn difference_of_means(drawn: &[[f64; 3]], other: &[[f64; 3]]) -> (Vec<f64>, f64) {
    let difference: Vec<f64> = drawn.iter().zip(other).map(|(a, b)| mean(a) - mean(b)).collect();
    let largest = difference.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    (difference, largest)
}

/// Signed values in false colors, with their scale in the caption after `what`.
pub(super) fn signed_picture(
    name: impl Into<String>,
    what: &str,
    width: u32,
    values: &[f64],
    scale: f64,
) -> NamedPicture {
    let caption = format!("{what} blue -{0}, white 0, red +{0}", shown(scale, Quantity::Measured));
    NamedPicture::new(name, false_color::signed(width, values, scale), caption)
}

/// Exposure that makes visible pixels 18 % grey on average.
pub(in crate::study) fn auto_exposure(colors: &[[f64; 3]]) -> f64 {
    let lit: Vec<f64> = colors.iter().map(mean).filter(|&value| value > 0.0).collect();
    let mean = lit.iter().sum::<f64>() / lit.len().max(1) as f64;
    if mean > 0.0 { MIDDLE_GREY / mean } else { 1.0 }
}

pub(super) fn single_picture(width: u32, height: u32, colors: &[[f64; 3]]) -> Picture {
    let single: Vec<[f32; 3]> = colors.iter().map(|color| color.map(|channel| channel as f32)).collect();
    Picture::rgb(width, height, &single)
}

pub(in crate::study) fn linear_picture(camera: &Camera, colors: &[[f64; 3]]) -> Picture {
    single_picture(camera.width(), camera.height(), colors)
}

/// Lat-long picture of the radiance from every direction, in the layout that `--light` reads: its middle is +y, its
/// right is +x, and up is +z. The median non-black pixel is 18 % grey.
pub(in crate::study) fn light_picture(
    name: impl Into<String>,
    light: &str,
    radiance: impl Fn(DVec3) -> [f64; 3] + Sync,
) -> Result<NamedPicture, InputError> {
    let height = LIGHT_WIDTH / 2;
    let pixel = |at: u32| {
        let [column, row] = [at % LIGHT_WIDTH, at / LIGHT_WIDTH].map(|center| f64::from(center) + 0.5);
        let (sine, cosine) = sin_cos(row * PI / f64::from(height));
        let (x, y) = sin_cos((column / f64::from(LIGHT_WIDTH) - 0.5) * TAU);
        radiance(DVec3::new(sine * x, sine * y, cosine)).map(|channel| channel.max(0.0))
    };
    let colors: Vec<[f64; 3]> = (0..LIGHT_WIDTH * height).into_par_iter().map(pixel).collect();
    let mut bright: Vec<f64> = colors.iter().map(mean).filter(|&value| value > 0.0).collect();
    bright.sort_by(f64::total_cmp);
    let exposure = bright.get(bright.len() / 2).map_or(1.0, |median| MIDDLE_GREY / median);
    let caption = format!("the light, {light}: its middle is +y, its right +x, up +z");
    Ok(NamedPicture::new(name, single_picture(LIGHT_WIDTH, height, &colors).display(exposure)?, caption))
}

/// Radiance of the texels of a cube of light by direction, for [`light_picture`].
pub(in crate::study) fn of_texels(texels: &[[f64; 3]]) -> impl Fn(DVec3) -> [f64; 3] + Sync {
    |direction| {
        let [face, column, row] = LIGHT_MAP.texel_of(direction);
        texels[(face * LIGHT_SIDE + row) * LIGHT_SIDE + column]
    }
}
