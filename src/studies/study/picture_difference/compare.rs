//! Comparison of two pictures: samples, SSIM, FLIP, and bounds.

use crate::error::InputError;
use crate::options::number;
use crate::picture::metrics::{
    ChannelDifference, DEFAULT_PPD, FlipMap, MAX_PPD, MIN_PPD, ScreenPicture, channels, flip, luminance_differences,
    signed_differences, ssim,
};
use crate::picture::{NO_COLOR, Picture};
use crate::study::{ProgressFn, StudyError};

/// Picture with its name in the findings.
#[derive(Clone, Debug)]
pub struct PictureInput {
    /// Name.
    pub name: String,
    /// Picture.
    pub picture: Picture,
}

/// Options of the comparison. Without bounds, the pictures must be equal.
#[derive(Clone, Debug, clap::Args)]
pub struct DifferenceOptions {
    /// Compare only this channel; may be given several times [default: all channels, the same in both pictures]
    #[arg(long = "channel", value_name = "NAME")]
    pub channels: Vec<String>,

    /// For SSIM, FLIP and the pictures: factor on linear light before it is shown on a screen, where 1 is white.
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = number::positive)]
    pub exposure: f64,

    /// For FLIP: pixels per degree that the observer sees, 1 to 1000 [default: 67.02, from 0.7 m in front of a screen
    /// 0.7 m wide with 3840 pixels across]
    #[arg(long, value_name = "N", value_parser = pixels_per_degree)]
    pub ppd: Option<f64>,

    /// The difference at the ends of the false colors [default: the 99th percentile of the differing pixels]
    #[arg(long, value_name = "X", value_parser = number::positive, requires = "out")]
    pub scale: Option<f64>,

    /// Largest root mean square difference allowed in a channel.
    #[arg(long, value_name = "X", value_parser = number::not_negative)]
    pub max_rmse: Option<f64>,

    /// Largest difference allowed in a sample.
    #[arg(long, value_name = "X", value_parser = number::not_negative)]
    pub max_error: Option<f64>,

    /// Largest mean FLIP allowed.
    #[arg(long, value_name = "X", value_parser = number::not_negative)]
    pub max_flip: Option<f64>,

    /// Smallest SSIM allowed.
    #[arg(long, value_name = "X", value_parser = number::finite)]
    pub min_ssim: Option<f64>,
}

impl DifferenceOptions {
    /// Pixels per degree of the observer.
    pub fn pixels_per_degree(&self) -> f64 {
        self.ppd.unwrap_or(DEFAULT_PPD)
    }

    /// Returns `true` if any bound is given.
    pub fn is_bounded(&self) -> bool {
        [self.max_rmse, self.max_error, self.max_flip, self.min_ssim].iter().any(Option::is_some)
    }
}

fn pixels_per_degree(text: &str) -> Result<f64, String> {
    let number = number::finite(text)?;
    let fits = (MIN_PPD..=MAX_PPD).contains(&number);
    if fits { Ok(number) } else { Err(format!("expected {MIN_PPD} to {MAX_PPD} pixels per degree, found `{text}`")) }
}

/// Two pictures, with the parameters of their comparison.
#[derive(Clone, Debug)]
pub struct PictureDifference {
    /// First and second picture; differences are second minus first.
    pub pictures: [PictureInput; 2],
    /// Options.
    pub options: DifferenceOptions,
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
    /// Luminance difference, second minus first, times the exposure, not clipped.
    pub(super) luminance: Vec<f64>,
}

impl PictureDifference {
    /// Compares the pictures.
    pub(super) fn compare(&self, progress: &mut ProgressFn<'_>) -> Result<DifferenceOutcome, StudyError> {
        let [first, second] = [&self.pictures[0].picture, &self.pictures[1].picture];
        progress("samples", 0, 3);
        let found = channels(first, second, &self.options.channels)?;
        let signed = signed_differences(first, second, &self.options.channels)?;
        progress("SSIM and FLIP", 1, 3);
        let perceptual = match self.perceptual(first, second) {
            // Depths and ids are compared by samples only.
            Err(error)
                if error.error_code() == NO_COLOR
                    && self.options.max_flip.is_none()
                    && self.options.min_ssim.is_none() =>
            {
                None
            }
            other => other?,
        };
        if self.options.min_ssim.is_some() && perceptual.as_ref().is_some_and(|perceptual| perceptual.ssim.is_none()) {
            let found = format!("{}x{}", first.width(), first.height());
            let what = format!("expected pictures of at least 11x11 pixels for SSIM, found {found}");
            return Err(StudyError::new("crossbar::picture::window", what));
        }
        Ok(DifferenceOutcome { channels: found, signed, perceptual })
    }

    fn perceptual(&self, first: &Picture, second: &Picture) -> Result<Option<PerceptualDifference>, InputError> {
        let exposure = self.options.exposure;
        let [one, other] = [ScreenPicture::new(first, exposure)?, ScreenPicture::new(second, exposure)?];
        let Some(flip) = flip(&one, &other, self.options.pixels_per_degree()) else { return Ok(None) };
        let ssim = ssim(&one, &other);
        drop([one, other]);
        let luminance = luminance_differences(first, second, exposure)?;
        Ok(Some(PerceptualDifference { ssim, flip, luminance }))
    }

    /// Returns `true` if all bounds hold.
    pub(super) fn holds(&self, outcome: &DifferenceOutcome) -> bool {
        let DifferenceOptions { max_rmse: rmse, max_error: maximum, max_flip: flip, min_ssim: ssim, .. } = self.options;
        if !self.options.is_bounded() {
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
