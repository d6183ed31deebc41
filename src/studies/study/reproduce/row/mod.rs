//! Rows: a printed value of a paper and ours, with a bound that was stated beforehand and the verdict.
//!
//! [`Explanation`]s are created only by a [`Sweep`] of the same run, and calibrated values are listed separately and
//! still have to lie within their bounds.

mod bound;
mod explanation;
mod figure;
mod sweep;

pub use bound::Bound;
pub use explanation::Explanation;
pub use figure::{Origin, PaperFigure};
pub use sweep::{Setting, Sweep};

/// Method by which our value was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Method {
    /// The paper's own equation with its printed rates.
    Equation,
    /// Drawn on an emulated card and timed from clocks, slots and bytes.
    Pipeline,
    /// Rendered through the whole engine, with its work counted and timed.
    Engine,
    /// A model of the paper's host.
    #[strum(to_string = "host model")]
    Host,
    /// Solved in f64.
    Solver,
}

/// Dependence of our value on printed values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Standing {
    /// Prediction: this value was not used; other printed ones were.
    Predicted {
        /// Printed values that were used; empty for none.
        from: &'static str,
    },
    /// Calibration: the value itself, or one that follows from it, determined a constant of the model, so that
    /// agreement is no evidence.
    Calibrated {
        /// Printed values that determined it.
        on: &'static str,
    },
    /// Count: from a run that uses no time and no printed value.
    Counted,
}

impl Standing {
    /// Printed values that our value depends on.
    pub const fn inputs(self) -> &'static str {
        match self {
            Self::Predicted { from: inputs } | Self::Calibrated { on: inputs } => inputs,
            Self::Counted => "",
        }
    }
}

/// Verdict on a row; tallies list the variants in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, strum::Display, strum::VariantArray)]
#[strum(serialize_all = "lowercase")]
pub enum RowVerdict {
    /// Within the bound, and the value was not used.
    Reproduced,
    /// Within the bound, but the value determined a constant of the model: no evidence.
    Calibrated,
    /// Outside the bound, and a sweep of this run reaches it.
    Explained,
    /// Outside the bound.
    Missed,
    /// The text is too vague to be tested; not a success either.
    #[strum(to_string = "too vague to judge")]
    TooVague,
}

/// Row: a value of a paper with ours.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperRow {
    /// Measured quantity.
    pub what: String,
    /// Card or host.
    pub device: &'static str,
    /// Method by which ours was computed.
    pub method: Method,
    /// Value of the paper.
    pub target: PaperFigure,
    /// Our value, in the unit of the paper's.
    pub ours: f64,
    /// Dependence of ours on printed values.
    pub standing: Standing,
    /// Tolerance, stated beforehand.
    pub bound: Bound,
    /// Set by [`Sweep::explain`] alone.
    explanation: Option<Explanation>,
}

impl PaperRow {
    /// Creates a row without explanation.
    pub fn new(
        what: impl Into<String>,
        (device, method): (&'static str, Method),
        target: PaperFigure,
        (ours, standing): (f64, Standing),
        bound: Bound,
    ) -> Self {
        Self { what: what.into(), device, method, target, ours, standing, bound, explanation: None }
    }

    /// Returns `true` if a value of ours would lie within the bound; always `false` where the text is too vague.
    pub fn admits(&self, value: f64) -> bool {
        self.bound.interval(&self.target).is_some_and(|[low, high]| (low..=high).contains(&value))
    }

    /// Relative difference: (ours - printed) / printed.
    pub fn difference(&self) -> f64 {
        (self.ours - self.target.value) / self.target.value
    }

    /// Verdict.
    pub fn verdict(&self) -> RowVerdict {
        let calibrated = matches!(self.standing, Standing::Calibrated { .. });
        if matches!(self.bound, Bound::TooVague) {
            RowVerdict::TooVague
        } else if self.admits(self.ours) {
            if calibrated { RowVerdict::Calibrated } else { RowVerdict::Reproduced }
        } else if self.explanation.is_some() {
            RowVerdict::Explained
        } else {
            RowVerdict::Missed
        }
    }

    /// Explanation of the row by a sweep, if it is outside its bound.
    pub fn explanation(&self) -> Option<&Explanation> {
        self.explanation.as_ref()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(super) fn row(ours: f64) -> PaperRow {
        let target = PaperFigure::printed(15.6, 1, "M/s", "section 6.1");
        let standing = Standing::Predicted { from: "" };
        PaperRow::new("tests", ("nv20", Method::Pipeline), target, (ours, standing), Bound::Relative(0.1))
    }

    #[test]
    fn a_value_outside_its_bound_is_missed_and_no_word_changes_that() {
        assert_eq!(
            [15.0, 18.0, 13.0].map(|ours| row(ours).verdict()),
            [RowVerdict::Reproduced, RowVerdict::Missed, RowVerdict::Missed]
        );
    }

    #[test]
    fn a_calibrated_value_proves_nothing_and_still_has_a_bound() {
        let standing = Standing::Calibrated { on: "itself" };
        assert_eq!(PaperRow { standing, ..row(15.6) }.verdict(), RowVerdict::Calibrated);
        assert_eq!(PaperRow { standing, ..row(10.0) }.verdict(), RowVerdict::Missed);
    }

    #[test]
    fn vague_text_is_no_success() {
        assert_eq!(PaperRow { bound: Bound::TooVague, ..row(15.6) }.verdict(), RowVerdict::TooVague);
    }

    #[test]
    fn differences_are_shares_of_what_is_printed() {
        assert_eq!(row(31.2).difference(), 1.0);
        assert_eq!(row(7.8).difference(), -0.5);
    }
}
