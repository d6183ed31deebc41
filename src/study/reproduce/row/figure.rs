//! A paper's figure and its origin.

use crate::report::Cell;

/// Where a figure comes from.
#[derive(Clone, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Origin {
    /// It stands in the paper.
    Printed,
    /// It follows from printed figures by arithmetic: the formula.
    Implied(String),
    /// We concluded it; the paper says neither the figure nor how to work it out.
    Inferred(String),
}

impl Origin {
    /// The formula or the conclusion; nothing for what is printed.
    pub fn how(&self) -> &str {
        match self {
            Self::Printed => "",
            Self::Implied(how) | Self::Inferred(how) => how,
        }
    }
}

/// A paper's figure.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperFigure {
    /// The value, in units of `unit`.
    pub value: f64,
    /// Digits behind the point, as printed.
    pub decimals: u8,
    /// The unit.
    pub unit: &'static str,
    /// Where it stands.
    pub place: &'static str,
    /// Whether it is printed, implied or inferred.
    pub origin: Origin,
}

impl PaperFigure {
    /// A figure that stands in the paper.
    pub const fn printed(value: f64, decimals: u8, unit: &'static str, place: &'static str) -> Self {
        Self { value, decimals, unit, place, origin: Origin::Printed }
    }

    /// Half a unit of the last printed digit.
    pub fn rounding(&self) -> f64 {
        (0..self.decimals).fold(0.5, |half: f64, _| half / 10.0)
    }

    /// The value as it is printed, marked with its origin where that is not print.
    pub fn cell(&self) -> Cell {
        let mark = match self.origin {
            Origin::Printed => "",
            Origin::Implied(_) => "(implied)",
            Origin::Inferred(_) => "(inferred)",
        };
        Cell::decimals(self.value, self.decimals).marked(mark)
    }

    /// A value of ours beside it: one digit more, but for numbers of so many digits that nobody needs another.
    pub fn beside(&self, ours: f64) -> Cell {
        let more = u8::from(self.value.abs() < 1000.0);
        Cell::decimals(ours, self.decimals.saturating_add(more))
    }

    /// The value as it is printed, with its origin where that is not print.
    pub fn text(&self) -> String {
        self.cell().text()
    }
}
