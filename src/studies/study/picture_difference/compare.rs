//! Comparison of two pictures: samples, SSIM, FLIP, and bounds.

use crate::picture::metrics::{
    ChannelDifference, FlipMap, MismatchError, ScreenPicture, channels, flip, luminance_differences,
    signed_differences, ssim,
};
use crate::picture::{Picture, PictureError};
use crate::study::error::library_errors;
use crate::study::{ProgressFn, StudyError};

library_errors! {
    MismatchError;
}

/// Picture with its name in the findings.
#[derive(Clone, Debug)]
pub struct PictureInput {
    /// Name.
    pub name: String,
    /// Picture.
    pub picture: Picture,
}

/// Bounds on the difference; without any, the pictures must be equal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DifferenceBounds {
    /// Maximum root mean square difference of a channel.
    pub rmse: Option<f64>,
    /// Maximum difference of a sample.
    pub maximum: Option<f64>,
    /// Maximum mean FLIP.
    pub flip: Option<f64>,
    /// Minimum structural similarity.
    pub ssim: Option<f64>,
}

/// Two pictures, with the parameters of their comparison.
#[derive(Clone, Debug)]
pub struct PictureDifference {
    /// First and second picture; differences are second minus first.
    pub pictures: [PictureInput; 2],
    /// Channels that are compared; all if empty.
    pub channels: Vec<String>,
    /// Factor of linear light before display encoding.
    pub exposure: f64,
    /// Pixels per degree of the observer.
    pub ppd: f64,
    /// Magnitude at the ends of the false-color scale; `None` for the 99th percentile of the pixels that differ.
    pub scale: Option<f64>,
    /// Bounds.
    pub bounds: DifferenceBounds,
    /// `true` to add maps and a page.
    pub maps: bool,
}

/// Result of a comparison.
#[derive(Debug)]
pub(super) struct DifferenceOutcome {
    pub(super) channels: Vec<ChannelDifference>,
    pub(super) signed: Vec<(String, Vec<f32>)>,
    pub(super) perceptual: Option<PerceptualDifference>,
}

/// Perceptual difference.
#[derive(Debug)]
pub(super) struct PerceptualDifference {
    pub(super) ssim: Option<f64>,
    pub(super) flip: FlipMap,
    /// Second minus first, of the luminance times the exposure, not clipped.
    pub(super) luminance: Vec<f64>,
}

impl PictureDifference {
    /// Compares the pictures.
    pub(super) fn compare(&self, progress: &mut ProgressFn<'_>) -> Result<DifferenceOutcome, StudyError> {
        let [first, second] = [&self.pictures[0].picture, &self.pictures[1].picture];
        progress("samples", 0, 3);
        let found = channels(first, second, &self.channels)?;
        let signed = signed_differences(first, second, &self.channels)?;
        progress("SSIM and FLIP", 1, 3);
        let perceptual = match self.perceptual(first, second) {
            // Depths and ids are compared by samples only.
            Err(PictureError::NoColor { .. }) if self.bounds.flip.is_none() && self.bounds.ssim.is_none() => None,
            other => other?,
        };
        if self.bounds.ssim.is_some() && perceptual.as_ref().is_some_and(|perceptual| perceptual.ssim.is_none()) {
            let found = format!("{}x{}", first.width(), first.height());
            let what = format!("expected pictures of at least 11x11 pixels for SSIM, found {found}");
            return Err(StudyError::new("crossbar::picture::window", what));
        }
        Ok(DifferenceOutcome { channels: found, signed, perceptual })
    }

    fn perceptual(&self, first: &Picture, second: &Picture) -> Result<Option<PerceptualDifference>, PictureError> {
        let [one, other] = [ScreenPicture::new(first, self.exposure)?, ScreenPicture::new(second, self.exposure)?];
        let Some(flip) = flip(&one, &other, self.ppd) else { return Ok(None) };
        let ssim = ssim(&one, &other);
        drop([one, other]);
        let luminance = luminance_differences(first, second, self.exposure)?;
        Ok(Some(PerceptualDifference { ssim, flip, luminance }))
    }

    /// Returns `true` if all bounds hold.
    pub(super) fn holds(&self, outcome: &DifferenceOutcome) -> bool {
        let DifferenceBounds { rmse, maximum, flip, ssim } = self.bounds;
        if self.bounds == DifferenceBounds::default() {
            return outcome.channels.iter().all(|channel| channel.differing == 0);
        }
        let within = |found: f64, most: Option<f64>| most.is_none_or(|most| found <= most);
        let channel = |channel: &ChannelDifference| match channel.whole {
            // Ids are only compared for equality.
            true => channel.differing == 0,
            false => channel.not_finite == 0 && within(channel.rmse, rmse) && within(channel.maximum, maximum),
        };
        let perceptual = outcome.perceptual.as_ref().is_none_or(|perceptual| {
            within(perceptual.flip.mean, flip)
                && ssim.is_none_or(|least| perceptual.ssim.is_some_and(|found| found >= least))
        });
        outcome.channels.iter().all(channel) && perceptual
    }
}
