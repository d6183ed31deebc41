//! Parsing and printing of values in definitions.

use super::error::{ErrorKind, SyntaxError, quote};
use super::limits::MAX_NUMBER;
use crate::isa::Span;
use crate::num::Format;
use crate::num::decimal::{from_decimal, to_decimal};

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
        "nine digits are enough for every fp32 number",
    ))
}

/// Parses a value of `def` as fp32 bits, rounded to nearest even. `text` includes the sign.
pub(super) fn float(text: &str, span: Span) -> Result<u32, SyntaxError> {
    check_length(text, span)?;
    if text.contains(['x', 'X']) {
        return match text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
            Some(digits) if digits.len() == 8 => u32::from_str_radix(digits, 16).ok(),
            _ => None,
        }
        .ok_or_else(|| malformed("`0x` and eight hexadecimal digits, without a sign", text, span));
    }
    let decimal = text.strip_suffix(['f', 'F']).unwrap_or(text);
    match from_decimal(Format::FP32, decimal) {
        Err(_) => Err(malformed("a decimal number", text, span)),
        Ok(outcome) if Format::FP32.is_finite(outcome.bits) => Ok(outcome.bits),
        Ok(_) => Err(out_of_range(
            "a value within fp32, at most 3.4028235e38",
            text,
            span,
            "write `0x7f800000` if infinity is meant",
        )),
    }
}

/// Parses an unsigned number of an OpenGL program: as [`float`], but without a trailing `f`.
pub(super) fn opengl_float(text: &str, span: Span) -> Result<u32, SyntaxError> {
    let hexadecimal = text.contains(['x', 'X']);
    if hexadecimal || text.ends_with(|c: char| c.is_ascii_digit() || c == '.') {
        return float(text, span);
    }
    Err(malformed("a decimal number", text, span))
}

/// The shortest text that [`float`] parses back to `bits`.
pub(super) fn float_text(bits: u32) -> String {
    if Format::FP32.is_finite(bits) { to_decimal(&Format::FP32, bits) } else { format!("0x{bits:08x}") }
}

/// Parses an integer of `defi`. `text` includes the sign.
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
