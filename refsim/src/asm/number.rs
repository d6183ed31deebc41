//! Values of definitions: decimals to bits and back.

use super::MAX_NUMBER;
use super::error::{ErrorKind, SyntaxError, quote};
use crate::isa::Span;

/// The largest decimal exponent that is looked at; far outside what fp32 can hold, so that a hostile one costs nothing.
const MAX_EXPONENT: u32 = 1000;

fn malformed(expected: &str, found: &str, span: Span) -> SyntaxError {
    SyntaxError::new(
        ErrorKind::MalformedValue,
        span,
        expected,
        quote(found),
        "write `1`, `-0.5`, `2.5e-3` or the bits of a float, `0x3f800000`",
    )
}

fn out_of_range(what: &str, found: &str, span: Span, help: &str) -> SyntaxError {
    SyntaxError::new(ErrorKind::ValueRange, span, what, quote(found), help)
}

fn check_length(text: &str, span: Span) -> Result<(), SyntaxError> {
    if text.len() <= MAX_NUMBER {
        return Ok(());
    }
    Err(out_of_range(
        &format!("a number of at most {MAX_NUMBER} characters"),
        &format!("{} characters", text.len()),
        span,
        "nine digits say everything that fp32 can hold",
    ))
}

/// The fp32 bits of a `def`'s value, rounded to nearest even. `text` carries its sign.
pub(super) fn float(text: &str, span: Span) -> Result<u32, SyntaxError> {
    check_length(text, span)?;
    let unsigned = text.trim_start_matches(['-', '+']);
    if let Some(digits) = unsigned.strip_prefix("0x").or_else(|| unsigned.strip_prefix("0X")) {
        let whole = digits.len() == 8 && unsigned.len() == text.len();
        return match u32::from_str_radix(digits, 16) {
            Ok(bits) if whole => Ok(bits),
            _ => Err(malformed("`0x` and eight hexadecimal digits, without a sign", text, span)),
        };
    }
    let text = text.strip_suffix(['f', 'F']).unwrap_or(text);
    let exponent = split(unsigned.strip_suffix(['f', 'F']).unwrap_or(unsigned));
    let Some(exponent) = exponent else {
        return Err(malformed("a decimal number", text, span));
    };
    let too_large = || {
        out_of_range("a value within fp32, at most 3.4028235e38", text, span, "write `0x7f800000` if infinity is meant")
    };
    if exponent.parse::<i32>().is_ok_and(|e| e.unsigned_abs() > MAX_EXPONENT) {
        return Err(out_of_range(
            &format!("an exponent within -{MAX_EXPONENT} to {MAX_EXPONENT}"),
            text,
            span,
            "fp32 holds 1.4e-45 to 3.4028235e38",
        ));
    }
    decimal_to_bits(text).filter(|bits| bits & 0x7f80_0000 != 0x7f80_0000).ok_or_else(too_large)
}

/// The exponent's text (`0` where there is none) of a well-formed unsigned decimal.
fn split(text: &str) -> Option<&str> {
    let digits = |s: &str| s.bytes().all(|b| b.is_ascii_digit());
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], &text[at + 1..]),
        None => (text, "0"),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let magnitude = exponent.strip_prefix(['-', '+']).unwrap_or(exponent);
    let good = digits(whole)
        && digits(fraction)
        && !(whole.is_empty() && fraction.is_empty())
        && digits(magnitude)
        && (1..=9).contains(&magnitude.len());
    good.then_some(exponent)
}

/// The bits of a well-formed decimal; `None` where it can't be read.
fn decimal_to_bits(text: &str) -> Option<u32> {
    text.parse::<f32>().ok().map(f32::to_bits)
}

/// The shortest text that [`float`] reads back to `bits`.
pub(super) fn float_text(bits: u32) -> String {
    let value = f32::from_bits(bits);
    if !value.is_finite() {
        return format!("0x{bits:08x}");
    }
    let plain = format!("{value}");
    let scientific = format!("{value:e}");
    if plain.len() <= scientific.len() { plain } else { scientific }
}

/// An integer of a `defi`. `text` carries its sign.
pub(super) fn integer(text: &str, span: Span) -> Result<i32, SyntaxError> {
    check_length(text, span)?;
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return Err(malformed("an integer", text, span));
    }
    text.parse().map_err(|_| {
        out_of_range(
            "an integer of 32 bits",
            text,
            span,
            "loops count to 255; a `defi` holds -2147483648 to 2147483647",
        )
    })
}
