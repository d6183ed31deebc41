//! Explanations of rows outside their bounds.

use crate::study::reproduce::prose::number;

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
