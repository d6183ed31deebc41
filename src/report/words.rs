//! Numbers of things, in words.

/// A count and its noun in the right number: `1 leak`, `0 leaks`.
pub fn counted(count: u64, one: &str, many: &str) -> String {
    format!("{} {}", grouped(count), if count == 1 { one } else { many })
}

/// A count with a comma between groups of three digits.
pub fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A share as a percentage of at least two digits.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let magnitude = percent.abs();
    match () {
        () if percent == 0.0 => "0 %".to_owned(),
        () if magnitude >= 10.0 => format!("{percent:.1} %"),
        () if magnitude >= 0.1 => format!("{percent:.2} %"),
        () => format!("{percent:.1e} %"),
    }
}

/// Names as a list in a sentence: `a`, `a and b`, `a, b and c`.
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
    fn digits_are_grouped_from_the_right() {
        let texts = [0, 999, 1000, 66_448, 1_234_567].map(grouped);
        assert_eq!(texts, ["0", "999", "1,000", "66,448", "1,234,567"]);
    }

    #[test]
    fn small_shares_keep_their_digits() {
        let texts = [0.0, 0.24639, -0.05098, 0.00963, 1.9e-7].map(percent);
        assert_eq!(texts, ["0 %", "24.6 %", "-5.10 %", "0.96 %", "1.9e-5 %"]);
    }

    #[test]
    fn lists_end_with_and() {
        assert_eq!(listed(&[""; 0]), "");
        assert_eq!(listed(&["a"]), "a");
        assert_eq!(listed(&["a", "b", "c"]), "a, b and c");
    }
}
