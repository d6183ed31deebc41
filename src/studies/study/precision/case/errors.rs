//! Measures of a case against its exact run.

use refsim::texture::Channel;

use super::drawn::{DrawnCase, codes};
use crate::picture::metrics::{ErrorSums, relative_error, value_error};
use crate::study::precision::subject::{NOT_FINITE, PrecisionMeasure};

/// Relative error above which a pixel is wrong, if its target has no codes.
const WRONG: f64 = 0.01;

pub(super) const LARGEST_CODES: PrecisionMeasure =
    PrecisionMeasure { name: "largest_codes", meaning: "largest difference of a stored code, of all integer channels" };
pub(super) const MEASURES: [PrecisionMeasure; 5] = [
    PrecisionMeasure {
        name: "mean_relative",
        meaning: "mean relative error of all channels of all pixels; 1 where only the exact value is 0",
    },
    PrecisionMeasure { name: "largest_relative", meaning: "largest relative error; 1 where only the exact value is 0" },
    PrecisionMeasure { name: "largest_absolute", meaning: "largest absolute error" },
    PrecisionMeasure {
        name: "wrong_pixels",
        meaning: "share of pixels, in [0, 1], with a channel that is off by more than one code, or by more than 1 % of \
                  the exact value if it is a float",
    },
    NOT_FINITE,
];
pub(super) const SSIM: PrecisionMeasure =
    PrecisionMeasure { name: "ssim", meaning: "structural similarity of target 0 as displayed; 1 if equal" };
pub(super) const FLIP: PrecisionMeasure =
    PrecisionMeasure { name: "flip", meaning: "mean FLIP of target 0 as displayed, in [0, 1]; 0 if equal" };

/// Sums over all channels of all pixels.
#[derive(Default)]
pub(super) struct CaseErrors {
    relative: ErrorSums,
    largest_absolute: f64,
    largest_codes: f64,
    /// Per pixel, `true` if a channel is wrong.
    wrong: Vec<bool>,
    /// Target, index of the value, and its badness.
    pub(super) worst: Option<(usize, usize, f64)>,
}

impl CaseErrors {
    pub(super) fn new(ours: &DrawnCase, exact: &DrawnCase, pixels: usize) -> Self {
        let mut errors = Self { wrong: vec![false; pixels], ..Self::default() };
        for (target, (ours, exact)) in ours.targets.iter().zip(&exact.targets).enumerate() {
            for (at, (&value, &right)) in ours.values.iter().zip(&exact.values).enumerate() {
                let count = exact.channels.len();
                errors.add([target, at, at / count], exact.channels[at % count], value, right);
            }
        }
        errors
    }

    fn add(&mut self, [target, at, pixel]: [usize; 3], channel: Channel, value: f64, right: f64) {
        let (absolute, relative) = (value_error(value, right).abs(), relative_error(value, right));
        self.relative.add(relative, 1.0);
        if absolute == 0.0 {
            return;
        }
        self.largest_absolute = self.largest_absolute.max(absolute);
        // Codes are integers, but their values here are quotients.
        let off = codes(channel).map(|codes| (absolute * codes).round());
        self.largest_codes = self.largest_codes.max(off.unwrap_or(0.0));
        self.wrong[pixel] |= off.map_or(relative > WRONG, |off| off > 1.0);
        let badness = off.unwrap_or(relative);
        if self.worst.is_none_or(|(.., worst)| badness > worst) {
            self.worst = Some((target, at, badness));
        }
    }

    pub(super) fn values(&self) -> [(&'static str, f64); 6] {
        let wrong = self.wrong.iter().filter(|wrong| **wrong).count();
        [
            ("largest_codes", self.largest_codes),
            ("mean_relative", self.relative.mean()),
            ("largest_relative", self.relative.largest),
            ("largest_absolute", self.largest_absolute),
            ("wrong_pixels", wrong as f64 / self.wrong.len().max(1) as f64),
            ("not_finite", self.relative.not_finite as f64),
        ]
    }
}
