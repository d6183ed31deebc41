//! Counts, percentages and lists in prose.

use super::digits::{self, Quantity, shown};

/// Formats a count with its noun: `1 leak`, `0 leaks`.
pub fn counted(count: u64, one: &str, many: &str) -> String {
    format!("{} {}", digits::count(count), if count == 1 { one } else { many })
}

/// Formats a fraction as a percentage.
pub fn percent(share: f64) -> String {
    format!("{} %", shown(100.0 * share, Quantity::Percent))
}

/// Formats names as a list in a sentence: `a`, `a and b`, `a, b and c`.
pub fn listed(names: &[impl AsRef<str>]) -> String {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    match &names[..] {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
