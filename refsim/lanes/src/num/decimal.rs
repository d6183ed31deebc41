//! Correctly rounded conversion between decimal text of any length and bits.

use num_bigint::BigUint;

use super::env::Env;
use super::flags::Outcome;
use super::format::Format;
use super::round::{from_parts, infinite, round_big, zero};
use super::unpack::{Unpacked, invalid, nan_result, unpack};

/// Number of significant digits read; later nonzero digits only set a sticky bit. The midpoint between two neighbours
/// of any format has fewer than 200 digits.
const DIGITS: usize = 800;
/// Larger decimal exponents overflow or underflow in every format (`2^128` has 39 digits, `2^-149` starts at the 45th
/// digit after the point).
const FAR: i64 = 400;

/// Text that is not a decimal number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error("decimal number `{text}`: expected {expected} at character {at}, found {found}")]
#[diagnostic(code(num::decimal), help("write a number like `-12.5`, `3e-7`, `inf` or `nan`, without spaces"))]
pub struct DecimalError {
    /// The text, cut short if it is very long.
    pub text: String,
    /// Position in characters, from 0.
    pub at: usize,
    /// The expected input.
    pub expected: &'static str,
    /// The input found.
    pub found: String,
}

/// Parses a decimal number and rounds it once into the format.
///
/// Grammar: an optional sign, then `inf`, `infinity` or `nan` in any case, or digits with at most one point and an
/// optional exponent (`e` or `E`, optional sign, digits). Any length and any exponent are accepted. In fixed point,
/// `inf` becomes the end of the range (`OVERFLOW`), and `nan` becomes zero (`INVALID`). In a wrapping format numbers
/// of magnitude `2^86` and more saturate.
///
/// # Errors
/// [`DecimalError`] if the text doesn't follow the grammar.
pub fn from_decimal(env: impl Into<Env>, text: &str) -> Result<Outcome, DecimalError> {
    let env = env.into();
    let (negative, body) = match text.as_bytes().first() {
        Some(b'-') => (true, &text[1..]),
        Some(b'+') => (false, &text[1..]),
        _ => (false, text),
    };
    if body.eq_ignore_ascii_case("inf") || body.eq_ignore_ascii_case("infinity") {
        return Ok(infinite(&env.format, negative));
    }
    if body.eq_ignore_ascii_case("nan") {
        let quiet = nan_result(&env.format, &[]);
        return Ok(if env.format.canonical_nan().is_none() { invalid(&env.format) } else { quiet });
    }
    let literal = scan(text, text.len() - body.len())?;
    Ok(round_decimal(&env, negative, &literal))
}

/// A scanned literal: `0.d1 d2 d3... * 10^point` with `d1` nonzero; `more` if nonzero digits were cut off.
struct Literal {
    digits: Vec<u8>,
    point: i64,
    more: bool,
}

fn scan(text: &str, start: usize) -> Result<Literal, DecimalError> {
    let bytes = text.as_bytes();
    let fail = |at: usize, expected| {
        let found = text.get(at..).and_then(|rest| rest.chars().next());
        DecimalError {
            text: text.chars().take(60).collect(),
            at: text.get(..at).map_or(at, |before| before.chars().count()),
            expected,
            found: found.map_or_else(|| "the end".to_owned(), |c| format!("`{c}`")),
        }
    };
    let mut literal = Literal { digits: Vec::new(), point: 0, more: false };
    let (mut at, mut any, mut after_point) = (start, false, false);
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'0'..=b'9' => {
                any = true;
                let leading = literal.digits.is_empty() && byte == b'0';
                if !leading && literal.digits.len() < DIGITS {
                    literal.digits.push(byte - b'0');
                } else if !leading {
                    literal.more |= byte != b'0';
                }
                literal.point += match (leading, after_point) {
                    (true, true) => -1,
                    (false, false) => 1,
                    _ => 0,
                };
            }
            b'.' if !after_point => after_point = true,
            _ => break,
        }
        at += 1;
    }
    if !any {
        return Err(fail(at, "a digit, `inf` or `nan`"));
    }
    if matches!(bytes.get(at), Some(b'e' | b'E')) {
        at += 1;
        let down = bytes.get(at) == Some(&b'-');
        at += usize::from(matches!(bytes.get(at), Some(b'-' | b'+')));
        let first = at;
        let mut exponent = 0i64;
        while let Some(digit) = bytes.get(at).filter(|b| b.is_ascii_digit()) {
            // Saturates far outside the range of every format.
            exponent = (exponent * 10 + i64::from(digit - b'0')).min(1 << 50);
            at += 1;
        }
        if at == first {
            return Err(fail(at, "a digit of the exponent"));
        }
        literal.point += if down { -exponent } else { exponent };
    }
    if at < bytes.len() {
        return Err(fail(at, "a digit, a point, an exponent or the end"));
    }
    Ok(literal)
}

fn count(digits: &[u8]) -> i64 {
    i64::try_from(digits.len()).unwrap_or(i64::MAX)
}

fn round_decimal(env: &Env, negative: bool, literal: &Literal) -> Outcome {
    let format = &env.format;
    if literal.digits.is_empty() {
        return zero(format, negative);
    }
    let too_large = || {
        let saturating = format.with_overflow(super::Overflow::Saturate);
        let format = if format.is_fixed() { saturating } else { *format };
        from_parts(Env { format, ..*env }, negative, 1, FAR as i32 * 4, false)
    };
    if literal.point > FAR {
        return too_large();
    }
    if literal.point < -FAR {
        return from_parts(*env, negative, 0, -4 * FAR as i32, true);
    }
    let mut all = literal.digits.clone();
    // A further nonzero digit represents the digits cut off.
    all.extend(literal.more.then_some(1));
    let digits = BigUint::from_radix_be(&all, 10).unwrap_or_default();
    let scale = literal.point - count(&all);
    let power = BigUint::from(10u32).pow(u32::try_from(scale.unsigned_abs()).unwrap_or(0));
    let (num, den) = if scale >= 0 { (digits * power, BigUint::from(1u32)) } else { (digits, power) };
    if format.is_fixed() && &num >> 86 >= den {
        return too_large();
    }
    round_big(env, negative, &num, &den)
}

/// Formats the exact value of `bits` with all its digits and no exponent: `-0.333251953125`, `65504`, `-0`, `inf`,
/// `nan`. A normalized number that is not an integer is a fraction: `37/255`.
pub fn to_decimal_exact(format: &Format, bits: u32) -> String {
    if let Unpacked::Finite { sign, sig, den, .. } = unpack(format, bits)
        && sig % u64::from(den) != 0
    {
        return format!("{}{sig}/{den}", if sign { "-" } else { "" });
    }
    let (sign, digits, point) = match expand(format, bits) {
        Ok(parts) => parts,
        Err(word) => return word.to_owned(),
    };
    plain(sign, &digits, point)
}

/// Formats `bits` as the shortest decimal text that [`from_decimal`] reads back to the same bits (of equally short
/// ones, the nearest to the value). Subnormals of a flushing format are written as zero. Large and small magnitudes are
/// written with an exponent. A normalized number in a format that rounds to odd may have no such text: no decimal
/// number is exactly two thirds, and all decimals near it may round to its odd neighbours.
pub fn to_decimal(format: &Format, bits: u32) -> String {
    let (sign, digits, point) = match expand(format, bits) {
        Ok(parts) => parts,
        Err(word) => return word.to_owned(),
    };
    let wanted = super::unpack::pass(format, bits);
    for length in 1..digits.len() {
        for (digits, point) in candidates(&digits, point, length) {
            let text = compact(sign, &digits, point);
            if from_decimal(format, &text).is_ok_and(|outcome| outcome.bits == wanted) {
                return text;
            }
        }
    }
    compact(sign, &digits, point)
}

/// Decimal places of a normalized number that is not an integer: enough to distinguish all numbers of a format.
const PLACES: u32 = 20;

/// Returns the sign, the digits without leading or trailing zeros, and the power of ten of the point as in [`Literal`].
/// Normalized numbers that are not integers are cut off after [`PLACES`] places.
fn expand(format: &Format, bits: u32) -> Result<(bool, Vec<u8>, i64), &'static str> {
    let (sign, sig, exp, den) = match unpack(format, bits) {
        Unpacked::Nan { .. } => return Err("nan"),
        Unpacked::Inf { sign: true } => return Err("-inf"),
        Unpacked::Inf { sign: false } => return Err("inf"),
        Unpacked::Finite { sign, sig, exp, den } => (sign, sig, exp, den),
    };
    if sig == 0 {
        return Ok((sign, Vec::new(), 0));
    }
    // sig * 2^-n = sig * 5^n / 10^n
    let (number, places) = if den != 1 {
        (BigUint::from(sig) * BigUint::from(10u32).pow(PLACES) / den, i64::from(PLACES))
    } else if exp >= 0 {
        (BigUint::from(sig) << exp.unsigned_abs(), 0)
    } else {
        (BigUint::from(sig) * BigUint::from(5u32).pow(exp.unsigned_abs()), i64::from(exp.unsigned_abs()))
    };
    let mut digits = number.to_radix_be(10);
    let point = count(&digits) - places;
    while digits.last() == Some(&0) {
        digits.pop();
    }
    Ok((sign, digits, point))
}

/// The two neighbours with `length` digits, nearer one first.
fn candidates(digits: &[u8], point: i64, length: usize) -> [(Vec<u8>, i64); 2] {
    let below = digits[..length].to_vec();
    let mut above = below.clone();
    let mut above_point = point;
    while above.last() == Some(&9) {
        above.pop();
    }
    match above.last_mut() {
        Some(digit) => *digit += 1,
        None => {
            above.push(1);
            above_point += 1;
        }
    }
    let upper_nearer = digits[length] > 5 || (digits[length] == 5 && digits.len() > length + 1);
    if upper_nearer { [(above, above_point), (below, point)] } else { [(below, point), (above, above_point)] }
}

/// Formats digits with a decimal point, or with an exponent where that would take many zeros.
fn compact(sign: bool, digits: &[u8], point: i64) -> String {
    if digits.is_empty() || (-4..=9).contains(&point) {
        return plain(sign, digits, point);
    }
    let mut text = plain(sign, digits, 1);
    text.push_str(&format!("e{}", point - 1));
    text
}

/// Formats digits with a decimal point and no exponent.
fn plain(sign: bool, digits: &[u8], point: i64) -> String {
    let mut text = String::from(if sign { "-" } else { "" });
    let push = |text: &mut String, digits: &[u8]| text.extend(digits.iter().map(|d| char::from(b'0' + d)));
    let zeros = |count: i64| vec![0u8; usize::try_from(count).unwrap_or(0)];
    if digits.is_empty() {
        text.push('0');
    } else if point <= 0 {
        text.push_str("0.");
        push(&mut text, &zeros(-point));
        push(&mut text, digits);
    } else {
        let whole = digits.len().min(usize::try_from(point).unwrap_or(0));
        push(&mut text, &digits[..whole]);
        push(&mut text, &zeros(point - count(&digits[..whole])));
        if whole < digits.len() {
            text.push('.');
            push(&mut text, &digits[whole..]);
        }
    }
    text
}
