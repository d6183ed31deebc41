//! Numbers, and prose with them.

use crate::report::digits::{Quantity, shown};

/// Formats a number with `decimals` decimals.
pub(super) fn number(value: f64, decimals: u8) -> String {
    shown(value, Quantity::Decimals(decimals))
}

/// Returns a paragraph: a template whose `{}` are replaced by numbers, in order.
pub(super) fn paragraph(template: &str, numbers: impl IntoIterator<Item = String>) -> String {
    let mut parts = template.split("{}");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for (number, part) in numbers.into_iter().zip(parts) {
        text.push_str(&number);
        text.push_str(part);
    }
    text
}

/// Smallest and largest of some numbers; infinite if there are none.
pub(super) fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}
