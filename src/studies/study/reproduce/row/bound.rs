//! Tolerances.

use crate::study::reproduce::prose::number;

/// Tolerance of a value. The rounding of the printed value is allowed in addition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Equal to the printed value when rounded to its number of digits.
    Print,
    /// Within this fraction of the paper's value.
    Relative(f64),
    /// Within this fraction of the gain of the paper's value over a value that calibrated the model. A prediction
    /// without gain is outside the bound.
    Gain {
        /// Fraction of the gain.
        share: f64,
        /// Value that calibrated the model.
        over: f64,
    },
    /// At least the paper's value.
    AtLeast,
    /// On the same side of 1 as the paper's ratio, so that the larger one of two values is the same.
    Order,
    /// Too vague to be tested.
    TooVague,
}

impl Bound {
    /// Allowed relative difference of a prediction, unless a narrower bound can be stated.
    pub const SHARE: f64 = 0.15;

    /// Smallest and largest value within the bound around a printed value, whose rounding error is at most `rounding`;
    /// `None` if the text is too vague.
    pub fn interval(&self, printed: f64, rounding: f64) -> Option<[f64; 2]> {
        let around = |by: f64| Some([printed - by, printed + by]);
        match *self {
            Self::Print => around(rounding),
            Self::Relative(share) => around(share * printed.abs() + rounding),
            Self::Gain { share, over } => around(share * (printed - over).abs() + rounding),
            Self::AtLeast => Some([printed - rounding, f64::INFINITY]),
            Self::Order if printed > 1.0 => Some([1.0_f64.next_up(), f64::INFINITY]),
            Self::Order => Some([f64::NEG_INFINITY, 1.0_f64.next_down()]),
            Self::TooVague => None,
        }
    }

    /// Returns `true` if a value lies within the bound around a printed value; always `false` if the text is too vague.
    pub fn admits(&self, printed: f64, rounding: f64, value: f64) -> bool {
        self.interval(printed, rounding).is_some_and(|[low, high]| (low..=high).contains(&value))
    }

    /// Formats the bound.
    pub fn text(&self) -> String {
        let percent = |share: f64| number(100.0 * share, 0);
        match *self {
            Self::Print => "every digit".to_owned(),
            Self::Relative(share) => format!("{} %", percent(share)),
            Self::Gain { share, .. } => format!("{} % of the gain", percent(share)),
            Self::AtLeast => "at least".to_owned(),
            Self::Order => "order".to_owned(),
            Self::TooVague => "none".to_owned(),
        }
    }
}
