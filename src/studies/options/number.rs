//! Numbers on the command line.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

use crate::io::{NumberError, parse_f32, parse_f64, to_f32};

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
    finite(text).and_then(|x| if x > 0.0 { Ok(x) } else { Err(format!("expected a number above 0, found `{text}`")) })
}

/// A finite number of at least 0.
pub fn not_negative(text: &str) -> Result<f64, String> {
    finite(text)
        .and_then(|x| if x >= 0.0 { Ok(x) } else { Err(format!("expected a number not below 0, found `{text}`")) })
}

/// A number above 0 and below 1.
pub fn share(text: &str) -> Result<f64, String> {
    let number = finite(text)?;
    let is_share = number > 0.0 && number < 1.0;
    if is_share { Ok(number) } else { Err(format!("expected a number above 0 and below 1, found `{text}`")) }
}

/// A number of at least 0 that fits single precision.
pub fn not_negative_single(text: &str) -> Result<f64, String> {
    let number = not_negative(text)?;
    to_f32(number).map(|_| number).map_err(|error| wrong(error, text))
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

/// A point in space, in double precision.
pub fn place(text: &str) -> Result<[f64; 3], String> {
    three_finite(text).ok_or_else(|| format!("expected three numbers as X,Y,Z, found `{text}`"))
}

fn wrong(error: NumberError, text: &str) -> String {
    format!("{error}, found `{text}`")
}
