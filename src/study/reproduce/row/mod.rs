//! A figure of a paper beside ours, judged by a bound that was stated beforehand.
//!
//! A verdict can't be talked into: [`Explanation`]s are made by a [`Sweep`] of the same run alone, and a calibrated
//! value is kept apart and still has to lie within its bound.

mod bound;
mod explanation;
mod figure;
mod sweep;

pub use bound::Bound;
pub use explanation::Explanation;
pub use figure::{Origin, PaperFigure};
pub use sweep::{Setting, Sweep};

/// How our value was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Method {
    /// The paper's own equation with its printed rates.
    Equation,
    /// Drawn on an emulated card and timed from clocks, slots and bytes.
    Pipeline,
    /// A rendering played to the whole engine, its work counted and timed.
    Engine,
    /// A model of the paper's host.
    #[strum(to_string = "host model")]
    Host,
    /// Solved in f64.
    Solver,
}

/// Whether printed figures went into our value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Standing {
    /// This figure had no part in it; what other printed figures had.
    Predicted {
        /// Printed figures that went in; empty for none.
        from: &'static str,
    },
    /// The figure itself, or one that follows from it, chose a constant of the model: agreement is no evidence.
    Calibrated {
        /// The printed figures that did.
        on: &'static str,
    },
    /// Counted in a run in which no time and no printed figure takes part.
    Counted,
}

impl Standing {
    /// The printed figures that went into our value.
    pub const fn inputs(self) -> &'static str {
        match self {
            Self::Predicted { from: inputs } | Self::Calibrated { on: inputs } => inputs,
            Self::Counted => "",
        }
    }
}

/// How a row came out; tallies list the variants in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, strum::Display, strum::VariantArray)]
#[strum(serialize_all = "lowercase")]
pub enum RowVerdict {
    /// Within the bound, and the figure had no part in it.
    Reproduced,
    /// Within the bound, but the figure chose a constant of the model: no evidence.
    Calibrated,
    /// Outside the bound, and a computation of this run reaches it.
    Explained,
    /// Outside the bound.
    Missed,
    /// The text is too vague to be missed: no success either.
    #[strum(to_string = "too vague to judge")]
    TooVague,
}

/// One figure of a paper with ours.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperRow {
    /// What is measured.
    pub what: String,
    /// The card, or the host.
    pub device: &'static str,
    /// How ours was computed.
    pub method: Method,
    /// The paper's.
    pub target: PaperFigure,
    /// Ours, in the unit of the paper's.
    pub ours: f64,
    /// Whether printed figures went into ours.
    pub standing: Standing,
    /// The tolerance, stated beforehand.
    pub bound: Bound,
    /// Set by [`Sweep::explain`] alone.
    explanation: Option<Explanation>,
}

impl PaperRow {
    /// A row without explanation.
    pub fn new(
        what: impl Into<String>,
        (device, method): (&'static str, Method),
        target: PaperFigure,
        (ours, standing): (f64, Standing),
        bound: Bound,
    ) -> Self {
        Self { what: what.into(), device, method, target, ours, standing, bound, explanation: None }
    }

    /// Whether a value of ours would lie within the bound; never where the text is too vague.
    pub fn admits(&self, value: f64) -> bool {
        self.bound.interval(&self.target).is_some_and(|[low, high]| (low..=high).contains(&value))
    }

    /// Relative difference: (ours - printed) / printed.
    pub fn difference(&self) -> f64 {
        (self.ours - self.target.value) / self.target.value
    }

    /// How it came out.
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

    /// The sweep that explains the row, if it is outside its bound.
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
