//! The comparison: samples, SSIM, FLIP, and what must hold.

use crate::picture::metrics::{
    ChannelDifference, FlipMap, MismatchError, ScreenPicture, channels, flip, luminance_differences,
    signed_differences, ssim,
};
use crate::picture::{Picture, PictureError};
use crate::report::ReportError;
use crate::study::ProgressFn;

/// A picture with its name in the findings.
#[derive(Clone, Debug)]
pub struct PictureInput {
    /// The name.
    pub name: String,
    /// The picture.
    pub picture: Picture,
}

/// What must hold; without any of these the pictures must be equal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DifferenceBounds {
    /// The largest root mean square difference of a channel.
    pub rmse: Option<f64>,
    /// The largest difference of a sample.
    pub maximum: Option<f64>,
    /// The largest mean FLIP.
    pub flip: Option<f64>,
    /// The least structural similarity.
    pub ssim: Option<f64>,
}

/// Two pictures, and how they are compared.
#[derive(Clone, Debug)]
pub struct PictureDifference {
    /// The first and the second picture; differences are second minus first.
    pub pictures: [PictureInput; 2],
    /// The channels that are compared; all if there are none.
    pub channels: Vec<String>,
    /// What linear light is multiplied by before a screen shows it.
    pub exposure: f64,
    /// Pixels per degree of the observer.
    pub ppd: f64,
    /// The number at the ends of the false colors of differences; if there is none, one that one in a hundred of the
    /// pixels that differ exceeds.
    pub scale: Option<f64>,
    /// What must hold.
    pub bounds: DifferenceBounds,
    /// Whether there are to be maps and a page.
    pub maps: bool,
}

/// Why pictures cannot be compared.
#[non_exhaustive]
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum DifferenceError {
    /// They have no samples in common.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Mismatch(#[from] MismatchError),
    /// A bound on what people see, of pictures without color.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Color(#[from] PictureError),
    /// A bound on SSIM, of pictures smaller than its window.
    #[error("expected pictures of at least 11x11 pixels for SSIM, found {width}x{height}")]
    #[diagnostic(code(crossbar::picture::window))]
    Window {
        /// Pixels per row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The findings cannot be encoded.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Report(#[from] ReportError),
}

/// What was found.
#[derive(Debug)]
pub(super) struct DifferenceOutcome {
    pub(super) channels: Vec<ChannelDifference>,
    pub(super) signed: Vec<(String, Vec<f32>)>,
    pub(super) seen: Option<SeenDifference>,
}

/// The difference as people see it.
#[derive(Debug)]
pub(super) struct SeenDifference {
    pub(super) ssim: Option<f64>,
    pub(super) flip: FlipMap,
    /// Second minus first, of the luminance times the exposure, not clipped.
    pub(super) luminance: Vec<f64>,
}

impl PictureDifference {
    /// Compares the pictures.
    pub(super) fn compare(&self, progress: &mut ProgressFn<'_>) -> Result<DifferenceOutcome, DifferenceError> {
        let [first, second] = [&self.pictures[0].picture, &self.pictures[1].picture];
        progress("samples", 0, 3);
        let found = channels(first, second, &self.channels)?;
        let signed = signed_differences(first, second, &self.channels)?;
        progress("SSIM and FLIP", 1, 3);
        let seen = match self.seen(first, second) {
            // Depths and ids are compared by their samples alone.
            Err(PictureError::NoColor { .. }) if self.bounds.flip.is_none() && self.bounds.ssim.is_none() => None,
            other => other?,
        };
        if self.bounds.ssim.is_some() && seen.as_ref().is_some_and(|seen| seen.ssim.is_none()) {
            return Err(DifferenceError::Window { width: first.width(), height: first.height() });
        }
        Ok(DifferenceOutcome { channels: found, signed, seen })
    }

    fn seen(&self, first: &Picture, second: &Picture) -> Result<Option<SeenDifference>, PictureError> {
        let [one, other] = [ScreenPicture::new(first, self.exposure)?, ScreenPicture::new(second, self.exposure)?];
        let Some(flip) = flip(&one, &other, self.ppd) else { return Ok(None) };
        let ssim = ssim(&one, &other);
        drop([one, other]);
        let luminance = luminance_differences(first, second, self.exposure)?;
        Ok(Some(SeenDifference { ssim, flip, luminance }))
    }

    /// Whether what must hold holds.
    pub(super) fn holds(&self, outcome: &DifferenceOutcome) -> bool {
        let DifferenceBounds { rmse, maximum, flip, ssim } = self.bounds;
        if self.bounds == DifferenceBounds::default() {
            return outcome.channels.iter().all(|channel| channel.differing == 0);
        }
        let within = |found: f64, most: Option<f64>| most.is_none_or(|most| found <= most);
        let channel = |channel: &ChannelDifference| match channel.whole {
            // Ids are the same or not.
            true => channel.differing == 0,
            false => channel.not_finite == 0 && within(channel.rmse, rmse) && within(channel.maximum, maximum),
        };
        let seen = outcome.seen.as_ref().is_none_or(|seen| {
            within(seen.flip.mean, flip) && ssim.is_none_or(|least| seen.ssim.is_some_and(|found| found >= least))
        });
        outcome.channels.iter().all(channel) && seen
    }
}
