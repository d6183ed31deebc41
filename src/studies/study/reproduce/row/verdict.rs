//! Verdicts on rows, and explanations of rows outside their bounds.

use crate::study::reproduce::prose::number;

/// Verdict on a row; tallies list the variants in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, strum::Display, strum::VariantArray)]
#[strum(serialize_all = "lowercase")]
pub enum RowVerdict {
    /// Measured on our side (drawn, solved, counted or timed), and within a numerical bound.
    Predicted,
    /// Measured on our side; the bound only says which of two values is larger.
    #[strum(to_string = "order only")]
    OrderOnly,
    /// Nothing is measured: the paper's printed values agree with each other or with its own equations.
    #[strum(to_string = "consistency of print")]
    Consistent,
    /// The bound admits every value that the computation can give: not evidence.
    #[strum(to_string = "by construction")]
    ByConstruction,
    /// Within the bound, but the value determined a constant of the model: not evidence.
    Calibrated,
    /// Outside the bound, but a sweep of this run reaches it.
    Explained,
    /// Outside the bound.
    Missed,
    /// The paper contradicts itself, and our value agrees with one of the contradicting values.
    Contradictory,
    /// The text is too vague to be tested; this is not a success.
    #[strum(to_string = "too vague to judge")]
    TooVague,
}

impl RowVerdict {
    /// Words that follow a number of rows, as in "3 predicted within numerical bounds".
    pub const fn of_rows(self) -> &'static str {
        match self {
            Self::Predicted => "predicted within numerical bounds",
            Self::OrderOnly => "met in order only",
            Self::Consistent => "consistent with the paper's own equations and values",
            Self::ByConstruction => "met by construction",
            Self::Calibrated => "calibrated",
            Self::Explained => "explained",
            Self::Missed => "missed",
            Self::Contradictory => "contradicted by their own paper",
            Self::TooVague => "too vague to judge",
        }
    }
}

/// Setting of a sweep at which a row that misses its bound lies within it. Only [`super::Sweep::explain`] creates it,
/// from values of the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    pub(super) sweep: &'static str,
    pub(super) parameter: &'static str,
    /// Setting at which the row lies within its bound.
    pub at: String,
    /// Value of the row at that setting.
    pub value: f64,
    pub(super) others: [usize; 2],
}

impl Explanation {
    /// Reason as a sentence; the same for all rows that one setting explains.
    pub fn reason(&self) -> String {
        let [held, all] = self.others;
        format!(
            "{}: at {} = {}, {held} of the {all} rows of the sweep lie within their bounds",
            self.sweep, self.parameter, self.at,
        )
    }

    /// Reason as a sentence, with the row's value at the setting.
    pub fn text(&self) -> String {
        format!("{}; the value of this row is {}", self.reason(), number(self.value, u8::from(self.value < 1000.0)))
    }
}
