//! Errors of values against exact ones, in the measures that cases and systems share.

use super::subject::PrecisionMeasure;
use crate::picture::metrics::{ErrorSums, relative_error, value_error};

/// Relative error above which a channel without codes is wrong.
const WRONG: f64 = 0.01;

pub(super) const LARGEST_CODES: PrecisionMeasure = PrecisionMeasure {
    name: "largest_codes",
    meaning: "largest difference of a stored code, over all integer channels; for systems, in steps of 1/255",
};

/// Measures of [`ValueErrors`], in the order of its values.
pub(super) const MEASURES: [PrecisionMeasure; 6] = [
    LARGEST_CODES,
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
    PrecisionMeasure {
        name: "not_finite",
        meaning: "number of channels that are infinite or NaN where the exact ones are not, or the reverse",
    },
];

/// Errors of all channels of all pixels.
#[derive(Default)]
pub(super) struct ValueErrors {
    relative: ErrorSums,
    largest_absolute: f64,
    largest_codes: f64,
    /// Per pixel, `true` if a channel is wrong.
    wrong: Vec<bool>,
    /// Indices of the target and of the value with the largest error, the first one on a tie, and that error: in codes
    /// if the channel has codes, otherwise relative.
    pub(super) worst: Option<([usize; 2], f64)>,
}

impl ValueErrors {
    /// Compares targets. Each has its values and the exact ones, pixel by pixel, and per channel the number of codes
    /// per unit, if it has codes.
    pub(super) fn of<'a>(
        targets: impl IntoIterator<Item = ([&'a [f64]; 2], &'a [Option<f64>])>,
        pixels: usize,
    ) -> Self {
        let mut errors = Self { wrong: vec![false; pixels], ..Self::default() };
        for (target, ([found, exact], codes)) in targets.into_iter().enumerate() {
            for (at, (&value, &right)) in found.iter().zip(exact).enumerate() {
                let (absolute, relative) = (value_error(value, right).abs(), relative_error(value, right));
                // Rounded to a millionth: codes are integers, but their values here are quotients.
                let off = codes[at % codes.len()].map(|codes| (1e6 * codes * absolute).round() / 1e6);
                errors.relative.add(relative, 1.0);
                errors.largest_absolute = errors.largest_absolute.max(absolute);
                errors.largest_codes = errors.largest_codes.max(off.unwrap_or(0.0));
                errors.wrong[at / codes.len()] |= off.map_or(relative > WRONG, |off| off > 1.0);
                let size = off.unwrap_or(relative);
                if size > errors.worst.map_or(0.0, |(_, worst)| worst) {
                    errors.worst = Some(([target, at], size));
                }
            }
        }
        errors
    }

    /// Values of [`MEASURES`].
    pub(super) fn values(&self) -> Vec<(&'static str, f64)> {
        let wrong = self.wrong.iter().filter(|wrong| **wrong).count();
        let values = [
            self.largest_codes,
            self.relative.mean(),
            self.relative.largest,
            self.largest_absolute,
            wrong as f64 / self.wrong.len().max(1) as f64,
            self.relative.not_finite as f64,
        ];
        MEASURES.iter().map(|measure| measure.name).zip(values).collect()
    }
}
