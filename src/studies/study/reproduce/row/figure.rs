//! Printed values of a paper with their origin.

use crate::report::Cell;

/// Origin of a value.
#[derive(Clone, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Origin {
    /// Printed in the paper.
    Printed,
    /// Follows from printed values by arithmetic: the formula.
    Implied(String),
    /// Inferred by us: the paper gives neither the value nor a way to compute it.
    Inferred(String),
}

impl Origin {
    /// Formula or inference; empty for printed values.
    pub fn how(&self) -> &str {
        match self {
            Self::Printed => "",
            Self::Implied(how) | Self::Inferred(how) => how,
        }
    }
}

/// Value of a paper.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperFigure {
    /// Value, in units of `unit`.
    pub value: f64,
    /// Digits after the point, as printed.
    pub decimals: u8,
    /// Unit.
    pub unit: &'static str,
    /// Place in the paper.
    pub place: &'static str,
    /// Origin: printed, implied or inferred.
    pub origin: Origin,
}

impl PaperFigure {
    /// Creates a printed value.
    pub const fn printed(value: f64, decimals: u8, unit: &'static str, place: &'static str) -> Self {
        Self { value, decimals, unit, place, origin: Origin::Printed }
    }

    /// Half a unit of the last printed digit.
    pub fn rounding(&self) -> f64 {
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

    /// Formats a value of ours beside it: with one more digit, unless the printed one has many.
    pub fn beside(&self, ours: f64) -> Cell {
        let more = u8::from(self.value.abs() < 1000.0);
        Cell::decimals(ours, self.decimals.saturating_add(more))
    }

    /// Formats the value as printed, with its origin if it is not printed.
    pub fn text(&self) -> String {
        self.cell().text()
    }
}
