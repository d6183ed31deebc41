//! Pictures as displayed on a screen, in double precision.

use super::super::channels::Picture;
use super::super::display::{clip, curve};
use super::luminance::WEIGHTS;
use crate::error::InputError;

/// Linear red, green and blue within [0, 1], rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct ScreenPicture {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) linear: Vec<[f64; 3]>,
}

impl ScreenPicture {
    /// Computes linear light times `exposure`, clipped at 1; NaN is black.
    pub fn new(picture: &Picture, exposure: f64) -> Result<Self, InputError> {
        let shown = |pixel: [f32; 3]| pixel.map(|channel| clip(f64::from(channel) * exposure));
        let linear = picture.linear()?.into_iter().map(shown).collect();
        Ok(Self { width: picture.width() as usize, height: picture.height() as usize, linear })
    }

    /// Luma: Rec. 709 weighted sum of the sRGB-encoded channels.
    pub fn luma(&self) -> Vec<f64> {
        let luma = |pixel: &[f64; 3]| [0, 1, 2].iter().map(|&c| WEIGHTS[c] * curve(pixel[c])).sum();
        self.linear.iter().map(luma).collect()
    }
}
