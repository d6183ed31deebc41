//! Printed values of a paper, with their origins, their bounds, and contradictions between them.

use serde::{Deserialize, Serialize};

use crate::report::Cell;
use crate::study::reproduce::Paper;
use crate::study::reproduce::prose::number;

/// Origin of a value.
#[derive(Clone, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Origin {
    /// Printed in the paper.
    Printed,
    /// Follows from printed values by arithmetic; this is the formula.
    Implied(String),
    /// Inferred by us: the paper gives neither the value nor a way to compute it.
    Inferred(String),
}

impl Origin {
    /// Formula or reason of the inference; empty for printed values.
    pub fn how(&self) -> &str {
        match self {
            Self::Printed => "",
            Self::Implied(how) | Self::Inferred(how) => how,
        }
    }
}

/// Judgement of a figure.
#[derive(Clone, Debug, PartialEq)]
pub enum Judgement {
    /// A row judges the figure within this bound.
    Within(Bound),
    /// No row judges the figure, for this reason.
    Not(String),
}

/// Reason why a row is missed, if known. Only missed rows have a reason; it does not change the verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::EnumString, strum::VariantArray)]
pub enum MissClass {
    /// The text allows several readings, or leaves a choice in the method open.
    #[strum(to_string = "reading open")]
    ReadingOpen,
    /// The paper's model, scene, light or BRDF is not available.
    #[strum(to_string = "model lost")]
    ModelLost,
    /// A time depends on hardware or a driver whose properties are not known.
    #[strum(to_string = "hardware timing unknown")]
    HardwareTiming,
    /// Our method or model deliberately differs from the paper's.
    #[strum(to_string = "ours differs")]
    OursDiffers,
    /// Our result has less error, storage or work than the printed result.
    #[strum(to_string = "ours differs, for the better")]
    OursBetter,
    /// Another section of the paper contradicts the figure, and our value agrees with neither.
    #[strum(to_string = "paper contradicts")]
    PaperContradicts,
}

/// A number that a paper prints or implies, and the judgement of our value by it.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperFigure {
    /// Paper.
    pub paper: Paper,
    /// Name: the paper's name and the figure's, as in `ray-engine/host-alone`.
    pub id: String,
    /// Measured quantity.
    pub what: String,
    /// Value, in units of `unit`.
    pub value: f64,
    /// Number of decimals, as printed.
    pub decimals: u8,
    /// Unit.
    pub unit: String,
    /// Table, figure or section of the paper.
    pub place: String,
    /// Origin: printed, implied or inferred.
    pub origin: Origin,
    /// Bound of the row that judges it, or the reason why no row judges it.
    pub judgement: Judgement,
    /// Date on which the judgement was stated or last changed.
    pub stated: String,
    /// Reason for the miss, if its row is missed.
    pub missed: Option<MissClass>,
    /// The equation of a row that follows only from printed values; `None` for other rows.
    pub equation: Option<PaperEquation>,
}

/// Row whose value is an expression of printed values: nothing is drawn, solved or counted for it.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperEquation {
    /// Entry to which the row belongs.
    pub entry: String,
    /// Card or host.
    pub device: String,
    /// Value of the expression, in the unit of the figure.
    pub ours: f64,
    /// Values for other readings.
    pub readings: Vec<f64>,
    /// Printed values that the expression uses; `None` if all of them are sizes or other numbers in the text.
    pub uses: Option<String>,
    /// Printed values that determined a constant of the expression.
    pub chose: Option<String>,
    /// Description of the computation, if a result that does not round to the printed value proves that the paper
    /// contradicts itself; otherwise `None`.
    pub contradicts: Option<String>,
}

impl PaperFigure {
    /// Half a unit of the last printed digit; 0 for inferred values, which were not rounded in print.
    pub fn rounding(&self) -> f64 {
        if matches!(self.origin, Origin::Inferred(_)) {
            return 0.0;
        }
        (0..self.decimals).fold(0.5, |half: f64, _| half / 10.0)
    }

    /// Formats the value as printed, marked with its origin if it is not printed.
    pub fn cell(&self) -> Cell {
        let mark = match self.origin {
            Origin::Printed => "",
            Origin::Implied(_) => "(implied)",
            Origin::Inferred(_) => "(inferred)",
        };
        Cell::decimals(self.value, self.decimals).marked(mark)
    }

    /// Formats our value for comparison: with one more digit, unless the printed value has many digits.
    pub fn beside(&self, ours: f64) -> Cell {
        let more = u8::from(self.value.abs() < 1000.0);
        Cell::decimals(ours, self.decimals.saturating_add(more))
    }

    /// Formats the value as printed, with its origin if it is not printed.
    pub fn text(&self) -> String {
        self.cell().text()
    }
}

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

/// Computation from printed values alone whose result differs from the printed value. The functions below create it,
/// and reject values that agree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contradiction {
    text: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    value: Option<f64>,
}

impl Contradiction {
    /// Contradiction of a figure by a value computed from other printed values, with a description of the computation;
    /// `None` if the value rounds to the printed value.
    pub fn between(figure: &PaperFigure, computed: f64, how: &str) -> Option<Self> {
        let decimals = figure.decimals + u8::from(figure.value.abs() < 1000.0);
        let text = || format!("{} {}: {how}", number(computed, decimals), figure.unit);
        let contradicts = (computed - figure.value).abs() > figure.rounding();
        contradicts.then(|| Self { text: text().trim().to_owned(), value: Some(computed) })
    }

    /// Contradiction that exists if a condition on printed values holds; `None` if it does not.
    pub fn if_holds(condition: bool, computation: impl Into<String>) -> Option<Self> {
        condition.then(|| Self { text: computation.into(), value: None })
    }

    /// The computation.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Value that contradicts the figure; `None` if the contradiction gives no value.
    pub const fn value(&self) -> Option<f64> {
        self.value
    }
}
