//! Prose with computed numbers.

use crate::report::digits::{Quantity, shown};

/// Formats a number with `decimals` digits after the point.
pub(super) fn number(value: f64, decimals: u8) -> String {
    shown(value, Quantity::Decimals(decimals))
}

/// Returns a paragraph: a template with numbers in the place of its `{}`, in their order.
pub(super) fn paragraph(template: &str, numbers: impl IntoIterator<Item = String>) -> String {
    let mut parts = template.split("{}");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for (number, part) in numbers.into_iter().zip(parts) {
        text.push_str(&number);
        text.push_str(part);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_in_their_places() {
        assert_eq!(paragraph("{} of {} rows", [number(2.0, 0), number(2.95, 1)]), "2 of 3.0 rows");
        assert_eq!(paragraph("all rows", []), "all rows");
    }

    #[test]
    fn nothing_reads_minus_zero() {
        assert_eq!((number(-0.04, 1), number(1540.0, 0)), ("0.0".to_owned(), "1,540".to_owned()));
    }
}
