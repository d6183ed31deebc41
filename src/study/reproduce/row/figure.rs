//! A paper's figure and its origin.

use crate::study::reproduce::prose::number;

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
    pub decimals: usize,
    /// The unit.
    pub unit: &'static str,
    /// Where it stands.
    pub place: &'static str,
    /// Whether it is printed, implied or inferred.
    pub origin: Origin,
}

impl PaperFigure {
    /// A figure that stands in the paper.
    pub const fn printed(value: f64, decimals: usize, unit: &'static str, place: &'static str) -> Self {
        Self { value, decimals, unit, place, origin: Origin::Printed }
    }

    /// Half a unit of the last printed digit.
    pub fn rounding(&self) -> f64 {
        (0..self.decimals).fold(0.5, |half: f64, _| half / 10.0)
    }

    /// The value as it is printed, with its origin where that is not print.
    pub fn text(&self) -> String {
        let value = number(self.value, self.decimals);
        if self.origin == Origin::Printed { value } else { format!("{value} ({})", self.origin) }
    }
}
