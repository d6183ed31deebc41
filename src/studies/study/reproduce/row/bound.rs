//! Tolerances.

use crate::study::reproduce::prose::number;

/// Tolerance of a value. The rounding of the printed value is allowed in addition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Equal to the printed value, rounded to as many digits.
    Print,
    /// Within this fraction of the paper's value.
    Relative(f64),
    /// Within this fraction of the gain of the paper's value over another one that calibrated the model. Predicting
    /// only that other value is outside.
    Gain {
        /// Fraction of the gain.
        share: f64,
        /// Value that calibrated the model.
        over: f64,
    },
    /// At least the paper's value.
    AtLeast,
    /// On the same side of 1 as the paper's ratio: the same one of two values is larger.
    Order,
    /// Too vague to be tested.
    TooVague,
}

impl Bound {
    /// Fraction by which a prediction may differ, unless a narrower one can be stated.
    pub const SHARE: f64 = 0.15;

    /// Smallest and largest value within the bound around a printed value, which may be off by `rounding`; `None` if
    /// all values are.
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

    /// Returns `true` if a value lies within the bound only because the printed value was rounded. To have every
    /// printed digit is no such case.
    pub fn needs_rounding(&self, (printed, rounding): (f64, f64), value: f64) -> bool {
        let within = |[low, high]: [f64; 2]| (low..=high).contains(&value);
        let held = |rounding: f64| self.interval(printed, rounding).is_some_and(within);
        !matches!(self, Self::Print) && held(rounding) && !held(0.0)
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

#[cfg(test)]
mod tests {
    use super::*;

    const PREDICTION: Bound = Bound::Relative(Bound::SHARE);

    fn admits(bound: Bound, (printed, rounding): (f64, f64), value: f64) -> bool {
        bound.interval(printed, rounding).is_some_and(|[low, high]| (low..=high).contains(&value))
    }

    #[test]
    fn digits_are_compared_as_printed() {
        assert!(admits(Bound::Print, (15.6, 0.05), 15.625) && !admits(Bound::Print, (15.6, 0.05), 15.66));
        assert!(admits(Bound::Print, (114.0, 0.5), 113.6) && !admits(Bound::Print, (114.0, 0.5), 114.6));
    }

    #[test]
    fn a_share_is_of_what_is_printed() {
        assert_eq!(Bound::Relative(0.1).interval(100.0, 0.5), Some([89.5, 110.5]));
    }

    /// Equal values have no order.
    #[test]
    fn an_order_is_a_side_of_1() {
        let side = |printed: f64| [1.01, 1.0, 0.9].map(|value| admits(Bound::Order, (printed, 0.005), value));
        assert_eq!(side(3.05), [true, false, false]);
        assert_eq!(side(0.4), [false, false, true]);
    }

    /// "About twice" is not satisfied by everything that rounds to 2.
    #[test]
    fn about_twice_is_no_wider_than_any_prediction() {
        let twice = (2.0, 0.05);
        assert!(admits(PREDICTION, twice, 1.8) && !admits(PREDICTION, twice, 1.6) && !admits(PREDICTION, twice, 2.4));
    }

    /// "About 8" is met by 6.713 within 15 % only if 8 may have been 7.9.
    #[test]
    fn rounding_is_told_from_the_bound() {
        let eight = (8.0, 0.5);
        assert!(admits(PREDICTION, eight, 6.713) && PREDICTION.needs_rounding(eight, 6.713));
        assert!(!PREDICTION.needs_rounding(eight, 6.9) && !PREDICTION.needs_rounding(eight, 6.0));
        assert!(!Bound::Print.needs_rounding(eight, 8.4));
    }

    /// A prediction that the card brings no gain is outside.
    #[test]
    fn the_calibrated_value_itself_is_outside() {
        let gained = (147_630.0, 0.5);
        let bound = Bound::Gain { share: 0.15, over: 135_812.0 };
        assert!(!admits(bound, gained, 135_812.0) && admits(bound, gained, 148_000.0));
        assert!(admits(PREDICTION, gained, 135_812.0), "as a share of the whole it would pass");
    }
}
