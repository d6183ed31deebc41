//! Numbers: decimal, hexadecimal and rational, as exact fractions.

use num_bigint::BigInt;
use num_traits::{One, Zero};

/// Maximum length of a number's text, and largest exponent.
const MAX: usize = 5000;

/// Syntax that [`parse`] accepts, for messages.
pub(super) const EXPECTED: &str =
    "expected a number of at most 5,000 characters, with an exponent within 5,000 and a denominator above 0";

/// Numerator and positive denominator of an FPCore number; `None` for other text.
pub(super) fn parse(text: &str) -> Option<(BigInt, BigInt)> {
    if text.len() > MAX {
        return None;
    }
    let (negative, magnitude) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (numerator, denominator) = match (magnitude.split_once('/'), magnitude.strip_prefix("0x")) {
        (Some((n, d)), _) => (digits(n, 10)?, Some(digits(d, 10)?).filter(|d| !d.is_zero())?),
        (_, Some(hexadecimal)) => scaled(hexadecimal, 16, 'p', 2)?,
        _ => scaled(magnitude, 10, 'e', 10)?,
    };
    Some((if negative { -numerator } else { numerator }, denominator))
}

fn digits(text: &str, radix: u32) -> Option<BigInt> {
    let all = !text.is_empty() && text.chars().all(|c| c.is_digit(radix));
    all.then(|| BigInt::parse_bytes(text.as_bytes(), radix))?
}

/// `1.5e3`: digits, then `mark` and a power of `base`.
fn scaled(text: &str, radix: u32, mark: char, base: u32) -> Option<(BigInt, BigInt)> {
    let lower = text.to_ascii_lowercase();
    let (mantissa, exponent) = lower.split_once(mark).unwrap_or((&lower, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let numerator = digits(&format!("{whole}{fraction}"), radix)?;
    let denominator = BigInt::from(radix).pow(u32::try_from(fraction.len()).ok()?);
    power((numerator, denominator), base, exponent.parse().ok()?)
}

/// A fraction times `base^exponent`.
fn power((n, d): (BigInt, BigInt), base: u32, exponent: i64) -> Option<(BigInt, BigInt)> {
    let size = u32::try_from(exponent.unsigned_abs()).ok().filter(|size| *size as usize <= MAX)?;
    let factor = BigInt::from(base).pow(size);
    Some(if exponent < 0 { (n, d * factor) } else { (n * factor, d) })
}

/// `(digits m e b)`: `m b^e`.
pub(super) fn with_base(m: &str, e: &str, b: &str) -> Option<(BigInt, BigInt)> {
    let base = b.parse().ok().filter(|base| *base > 1)?;
    power((parse(m).filter(|(_, d)| d.is_one())?.0, BigInt::one()), base, e.parse().ok()?)
}
