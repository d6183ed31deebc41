//! Number formatting for people: the digits depend on the kind of quantity, both on a terminal and on a page. Programs
//! get all digits.

/// Kind of quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// A setting, or a value shown in full: the shortest text that reads back to the same number.
    #[default]
    Exact,
    /// Printed value of a paper, or our value for it, with this many decimals.
    Decimals(u8),
    /// Measured or computed time, rate or size: four significant digits, and at least the integer part.
    Measured,
    /// Quotient of two quantities: three significant digits.
    Ratio,
    /// Percentage: one decimal; below 1 %, two significant digits.
    Percent,
    /// Error or deviation: three significant digits.
    Error,
}

/// Power of ten from which numbers are written with an exponent.
const LARGE: i32 = 15;
/// Power of ten below which numbers are written with an exponent.
const SMALL: i32 = -4;

/// Formats a number for people: thousands separated by commas, digits by quantity.
pub fn shown(value: f64, quantity: Quantity) -> String {
    if value == 0.0 || !value.is_finite() {
        return exact(value);
    }
    let text = match quantity {
        Quantity::Exact => exact(value),
        Quantity::Decimals(decimals) => fixed(value, usize::from(decimals)),
        Quantity::Percent if value.abs() >= 1.0 => fixed(value, 1),
        Quantity::Percent => significant(value, 2),
        // An integer is a count or was set to that value.
        _ if value.fract() == 0.0 && value.abs() < 1e15 => fixed(value, 0),
        Quantity::Measured => significant(value, 4),
        Quantity::Ratio | Quantity::Error => significant(value, 3),
    };
    grouped(&text)
}

/// Formats a count for people: `177,694`.
pub fn count(count: u64) -> String {
    grouped(&count.to_string())
}

/// Formats as the shortest text that reads back to the same number: plain digits near 1, an exponent far from 1.
pub fn exact(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !value.is_finite() || (1e-4..1e9).contains(&magnitude) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Separates the thousands of the integer part by commas.
pub(super) fn grouped(text: &str) -> String {
    let (sign, rest) = text.split_at(usize::from(text.starts_with('-')));
    let whole = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let (whole, rest) = rest.split_at(whole);
    let mut out = sign.to_owned();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && (whole.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out + rest
}

/// Formats with a fixed number of decimals; never as -0.
fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(zero) if zero.chars().all(|c| matches!(c, '0' | '.')) => zero.to_owned(),
        _ => text,
    }
}

/// Formats with a number of significant digits, and at least the integer part.
fn significant(value: f64, digits: i32) -> String {
    let places = usize::try_from(digits - 1).unwrap_or(0);
    let scientific = format!("{value:.places$e}");
    // The power of ten after rounding: 9.999 to three digits is 1.00e1.
    let power = scientific.split_once('e').and_then(|(_, power)| power.parse::<i32>().ok()).unwrap_or(0);
    if (SMALL..LARGE).contains(&power) {
        fixed(value, usize::try_from(digits - 1 - power).unwrap_or(0))
    } else {
        scientific
    }
}
