//! What explains a row outside its bound.

use crate::study::reproduce::prose::number;

/// A sweep's setting that reaches a figure that the row misses. Made by [`super::Sweep::explain`] alone, from values of
/// the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    pub(super) sweep: &'static str,
    pub(super) parameter: &'static str,
    pub(super) at: String,
    pub(super) value: f64,
    pub(super) others: [usize; 2],
}

impl Explanation {
    /// The sweep's name.
    pub const fn sweep(&self) -> &'static str {
        self.sweep
    }

    /// The setting at which the row lies within its bound.
    pub fn at(&self) -> &str {
        &self.at
    }

    /// The row's value there.
    pub const fn value(&self) -> f64 {
        self.value
    }

    /// What reaches the row, in words; the same for all rows that one setting explains.
    pub fn reason(&self) -> String {
        let [held, all] = self.others;
        format!(
            "{}: at {} = {}, {held} of the {all} rows of the sweep lie within their bounds",
            self.sweep, self.parameter, self.at,
        )
    }

    /// In words, with the row's value there.
    pub fn text(&self) -> String {
        format!("{}, this one with {}", self.reason(), number(self.value, u8::from(self.value < 1000.0)))
    }
}
