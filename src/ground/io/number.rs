//! Parsing of decimal numbers in files and options, in single and double precision.

use thiserror::Error;

/// Reasons why a text is not a number in single or double precision. Callers quote the text with its position.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("expected {}", self.expected())]
pub enum NumberError {
    /// The text is not a number.
    NoNumber,
    /// A NaN or an infinity, given by name.
    NotFinite,
    /// A number that rounds to infinity in single precision.
    TooLarge,
    /// A number that rounds to infinity in double precision.
    TooLargeForDouble,
}

impl NumberError {
    /// The text between "expected" and "found" in a message.
    pub const fn expected(self) -> &'static str {
        match self {
            Self::NoNumber => "a number",
            Self::NotFinite => "a finite number",
            Self::TooLarge => "a number that is not too large for a 32-bit float: at most 3.4028235e38",
            Self::TooLargeForDouble => "a number that is not too large for a 64-bit float",
        }
    }
}

/// Parses a decimal number, rounded to the nearest single-precision number.
pub fn parse_f32(text: &str) -> Result<f32, NumberError> {
    let number: f32 = text.parse().map_err(|_| NumberError::NoNumber)?;
    if number.is_finite() { Ok(number) } else { Err(not_finite(text, NumberError::TooLarge)) }
}

/// Parses a decimal number, rounded to the nearest double-precision number.
pub fn parse_f64(text: &str) -> Result<f64, NumberError> {
    let number: f64 = text.parse().map_err(|_| NumberError::NoNumber)?;
    if number.is_finite() { Ok(number) } else { Err(not_finite(text, NumberError::TooLargeForDouble)) }
}

/// Distinguishes a number that overflowed from an infinity or NaN given by name, which has no digits.
fn not_finite(text: &str, too_large: NumberError) -> NumberError {
    if text.contains(|c: char| c.is_ascii_digit()) { too_large } else { NumberError::NotFinite }
}

/// A number rounded from double to single precision; NaN and infinities are kept. Fails with [`NumberError::TooLarge`].
pub fn to_f32(number: f64) -> Result<f32, NumberError> {
    let rounded = number as f32;
    if number.is_finite() && rounded.is_infinite() { Err(NumberError::TooLarge) } else { Ok(rounded) }
}
