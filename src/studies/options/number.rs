//! Numbers on the command line.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

use crate::io::{NumberError, parse_f32, parse_f64};

/// A whole number in a range.
pub fn whole<T>(range: RangeInclusive<T>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: Clone + Display + FromStr + PartialOrd,
{
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        let expected = || format!("expected a whole number from {} to {}, found `{text}`", range.start(), range.end());
        number.ok_or_else(expected)
    }
}

/// A finite number.
pub fn finite(text: &str) -> Result<f64, String> {
    parse_f64(text.trim()).map_err(|error| wrong(error, text))
}

/// A finite number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    require(finite(text)?, |x| x > 0.0, "above 0", text)
}

/// A finite number of at least 0.
pub fn not_negative(text: &str) -> Result<f64, String> {
    require(finite(text)?, |x| x >= 0.0, "not below 0", text)
}

/// A number above 0 and below 1.
pub fn share(text: &str) -> Result<f64, String> {
    require(finite(text)?, |x| x > 0.0 && x < 1.0, "above 0 and below 1", text)
}

/// A finite number in single precision.
pub fn single(text: &str) -> Result<f32, String> {
    parse_f32(text.trim()).map_err(|error| wrong(error, text))
}

/// `1,2.5,-3` as three numbers in single precision; `form` describes the expected form.
pub fn three(text: &str, form: &str) -> Result<[f32; 3], String> {
    let parts: Vec<&str> = text.split(',').collect();
    let [x, y, z] = parts[..] else { return Err(format!("expected three numbers {form}, found `{text}`")) };
    Ok([single(x)?, single(y)?, single(z)?])
}

/// `1,2.5,-3` as a point.
pub fn point(text: &str) -> Result<[f32; 3], String> {
    three(text, "X,Y,Z")
}

/// `1,2.5,-3` as three finite numbers; `None` for anything else.
pub fn three_finite(text: &str) -> Option<[f64; 3]> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|number| number.trim().parse().ok().filter(|value: &f64| value.is_finite())).collect();
    numbers?.try_into().ok()
}

fn require(number: f64, is_right: fn(f64) -> bool, expected: &str, text: &str) -> Result<f64, String> {
    Some(number)
        .filter(|number| is_right(*number))
        .ok_or_else(|| format!("expected a number {expected}, found `{text}`"))
}

fn wrong(error: NumberError, text: &str) -> String {
    format!("{error}, found `{text}`")
}
