//! Printed values of a paper, with their origins.

use super::Bound;
use crate::report::Cell;
use crate::study::reproduce::Paper;

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
