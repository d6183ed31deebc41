//! Prose with computed numbers.

use std::fmt;

use crate::report::digits::{Quantity, shown};

/// Formats a number with `decimals` digits after the point.
pub fn number(value: f64, decimals: u8) -> String {
    shown(value, Quantity::Decimals(decimals))
}

/// Paragraph: a template, and the numbers that replace its `{}`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Prose {
    template: &'static str,
    figures: Vec<String>,
}

impl Prose {
    /// Creates a paragraph with its numbers, one per `{}`.
    pub fn new(template: &'static str, figures: impl IntoIterator<Item = String>) -> Self {
        Self { template, figures: figures.into_iter().collect() }
    }

    /// Template, as in the source.
    pub const fn template(&self) -> &'static str {
        self.template
    }

    /// Numbers, formatted, in the order of their places.
    pub(super) fn figures(&self) -> &[String] {
        &self.figures
    }

    /// Returns `true` if there are as many numbers as placeholders.
    pub fn is_whole(&self) -> bool {
        self.template.matches("{}").count() == self.figures.len()
    }
}

impl From<&'static str> for Prose {
    fn from(template: &'static str) -> Self {
        Self::new(template, [])
    }
}

impl fmt::Display for Prose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut figures = self.figures.iter();
        for (i, part) in self.template.split("{}").enumerate() {
            if i > 0 {
                f.write_str(figures.next().map_or("?", String::as_str))?;
            }
            f.write_str(part)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_stand_in_their_places() {
        let prose = Prose::new("{} of {} rows", [number(2.0, 0), number(2.95, 1)]);
        assert_eq!(prose.to_string(), "2 of 3.0 rows");
        assert!(prose.is_whole() && !Prose::from("{} rows").is_whole());
    }

    #[test]
    fn nothing_reads_minus_zero() {
        assert_eq!((number(-0.04, 1), number(1540.0, 0)), ("0.0".to_owned(), "1,540".to_owned()));
    }
}
