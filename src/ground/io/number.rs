//! Decimal numbers of files and options, in single and in double precision.

use serde::{Deserialize, Deserializer, de};
use thiserror::Error;

/// Why a piece of text is no number in single or double precision. What was found is quoted by those who know where it
/// stands.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("expected {}", self.expected())]
pub enum NumberError {
    /// No number at all.
    NoNumber,
    /// A NaN or an infinity, by name.
    NotFinite,
    /// A number that rounds to infinity in single precision.
    TooLarge,
    /// A number that rounds to infinity in double precision.
    TooLargeForDouble,
}

impl NumberError {
    /// What was expected, to stand between "expected" and "found".
    pub const fn expected(self) -> &'static str {
        match self {
            Self::NoNumber => "a number",
            Self::NotFinite => "a finite number",
            Self::TooLarge => "a number that is not too large for a 32-bit float: at most 3.4028235e38",
            Self::TooLargeForDouble => "a number that is not too large for a 64-bit float",
        }
    }
}

/// The number that a decimal text stands for, rounded to the nearest single-precision number.
pub fn parse_f32(text: &str) -> Result<f32, NumberError> {
    let number: f32 = text.parse().map_err(|_| NumberError::NoNumber)?;
    if number.is_finite() { Ok(number) } else { Err(not_finite(text, NumberError::TooLarge)) }
}

/// The same for the nearest double-precision number.
pub fn parse_f64(text: &str) -> Result<f64, NumberError> {
    let number: f64 = text.parse().map_err(|_| NumberError::NoNumber)?;
    if number.is_finite() { Ok(number) } else { Err(not_finite(text, NumberError::TooLargeForDouble)) }
}

/// Infinities and NaN have names without digits.
fn not_finite(text: &str, too_large: NumberError) -> NumberError {
    if text.contains(|c: char| c.is_ascii_digit()) { too_large } else { NumberError::NotFinite }
}

/// A number in double precision rounded to the nearest of single precision; NaN and infinities stay what they are.
///
/// # Errors
/// [`NumberError::TooLarge`].
pub fn to_f32(number: f64) -> Result<f32, NumberError> {
    let rounded = number as f32;
    if number.is_finite() && rounded.is_infinite() { Err(NumberError::TooLarge) } else { Ok(rounded) }
}

/// A number of a TOML file in single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Single(pub(crate) f32);

impl<'de> Deserialize<'de> for Single {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let number = f64::deserialize(deserializer)?;
        to_f32(number).map(Self).map_err(|error| de::Error::custom(format_args!("{error}, found {number:e}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_fault_has_its_name() {
        assert_eq!(parse_f32("3.4028235e38"), Ok(f32::MAX));
        assert_eq!(parse_f32("-1e-50"), Ok(-0.0));
        for (text, fault) in [
            ("five", NumberError::NoNumber),
            ("", NumberError::NoNumber),
            ("nan", NumberError::NotFinite),
            ("-inf", NumberError::NotFinite),
            ("infinity", NumberError::NotFinite),
            ("1e39", NumberError::TooLarge),
            ("-3.4028236e38", NumberError::TooLarge),
        ] {
            assert_eq!(parse_f32(text), Err(fault), "{text}");
            assert_eq!(fault.to_string(), format!("expected {}", fault.expected()));
        }
        assert_eq!((parse_f64("1e39"), parse_f64("1e-320")), (Ok(1e39), Ok(1e-320)));
        assert_eq!(parse_f64("1e400"), Err(NumberError::TooLargeForDouble));
        assert_eq!((parse_f64("x"), parse_f64("nan")), (Err(NumberError::NoNumber), Err(NumberError::NotFinite)));
        assert_eq!((to_f32(1e39), to_f32(f64::INFINITY)), (Err(NumberError::TooLarge), Ok(f32::INFINITY)));
    }
}
