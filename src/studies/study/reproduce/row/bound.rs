//! Tolerances, stated before values are computed.

use super::figure::{Origin, PaperFigure};
use crate::study::reproduce::prose::number;

/// Tolerance of a value, stated before it was computed. The rounding of the printed value is allowed in addition.
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
    /// Bound of predictions, unless a narrower one can be stated.
    pub const PREDICTION: Self = Self::Relative(Self::SHARE);
    /// Fraction by which a prediction may differ.
    pub const SHARE: f64 = 0.15;

    /// Smallest and largest value within the bound; `None` if all values are.
    pub fn interval(&self, target: &PaperFigure) -> Option<[f64; 2]> {
        let around = |by: f64| Some([target.value - by, target.value + by]);
        match *self {
            Self::Print => around(target.rounding()),
            Self::Relative(share) => around(share * target.value.abs() + target.rounding()),
            Self::Gain { share, over } => around(share * (target.value - over).abs() + target.rounding()),
            // Inferred values were not rounded in print.
            Self::AtLeast if matches!(target.origin, Origin::Inferred(_)) => Some([target.value, f64::INFINITY]),
            Self::AtLeast => Some([target.value - target.rounding(), f64::INFINITY]),
            Self::Order if target.value > 1.0 => Some([1.0_f64.next_up(), f64::INFINITY]),
            Self::Order => Some([f64::NEG_INFINITY, 1.0_f64.next_down()]),
            Self::TooVague => None,
        }
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

    fn target(value: f64, decimals: u8) -> PaperFigure {
        PaperFigure::printed(value, decimals, "M/s", "section 6.1")
    }

    fn admits(bound: Bound, target: &PaperFigure, value: f64) -> bool {
        bound.interval(target).is_some_and(|[low, high]| (low..=high).contains(&value))
    }

    #[test]
    fn digits_are_compared_as_printed() {
        let rate = target(15.6, 1);
        assert!(admits(Bound::Print, &rate, 15.625) && !admits(Bound::Print, &rate, 15.66));
        assert!(admits(Bound::Print, &target(114.0, 0), 113.6) && !admits(Bound::Print, &target(114.0, 0), 114.6));
    }

    #[test]
    fn a_share_is_of_what_is_printed() {
        let rate = target(100.0, 0);
        assert_eq!(Bound::Relative(0.1).interval(&rate), Some([89.5, 110.5]));
    }

    /// Equal values have no order.
    #[test]
    fn an_order_is_a_side_of_1() {
        let [more, less] = [target(3.05, 2), target(0.4, 1)];
        assert_eq!([1.01, 1.0, 0.9].map(|value| admits(Bound::Order, &more, value)), [true, false, false]);
        assert_eq!([1.01, 1.0, 0.9].map(|value| admits(Bound::Order, &less, value)), [false, false, true]);
    }

    /// "About twice" is not satisfied by everything that rounds to 2.
    #[test]
    fn about_twice_is_no_wider_than_any_prediction() {
        let twice = target(2.0, 1);
        assert!(admits(Bound::PREDICTION, &twice, 1.8) && !admits(Bound::PREDICTION, &twice, 1.6));
        assert!(!admits(Bound::PREDICTION, &twice, 2.4));
    }

    /// A prediction that the card brings no gain is outside.
    #[test]
    fn the_calibrated_value_itself_is_outside() {
        let gained = target(147_630.0, 0);
        let bound = Bound::Gain { share: 0.15, over: 135_812.0 };
        assert!(!admits(bound, &gained, 135_812.0) && admits(bound, &gained, 148_000.0));
        assert!(admits(Bound::Relative(0.15), &gained, 135_812.0), "as a share of the whole it would pass");
    }
}
