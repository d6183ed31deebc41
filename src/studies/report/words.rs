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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_singular_and_nothing_else_is() {
        let leaks = |count| counted(count, "leak", "leaks");
        assert_eq!([0, 1, 2, 21].map(leaks), ["0 leaks", "1 leak", "2 leaks", "21 leaks"]);
    }

    #[test]
    fn small_shares_keep_their_digits() {
        let texts = [0.0, 0.24639, -0.05098, 0.00963, 1.9e-7].map(percent);
        assert_eq!(texts, ["0 %", "24.6 %", "-5.1 %", "0.96 %", "1.9e-5 %"]);
    }

    #[test]
    fn lists_end_with_and() {
        assert_eq!(listed(&[""; 0]), "");
        assert_eq!(listed(&["a"]), "a");
        assert_eq!(listed(&["a", "b", "c"]), "a, b and c");
    }
}
