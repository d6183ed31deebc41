//! Decodes bit patterns into numbers.

use super::Outcome;
use super::flags::Flags;
use super::format::{Format, FormatKind};
use super::rules::{Denormals, Encoding};

/// A decoded number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unpacked {
    /// Not a number.
    Nan {
        /// The quiet bit is clear.
        signaling: bool,
    },
    /// An infinity.
    Inf {
        /// Negative.
        sign: bool,
    },
    /// `(-1)^sign * sig * 2^exp / den`; `sig` need not be normalised, and zero has a sign in floats.
    Finite {
        /// Negative, or -0.
        sign: bool,
        /// Magnitude in units of `2^exp`, at most `2^31`, or `2^53` for a double.
        sig: u64,
        /// Exponent of the unit.
        exp: i32,
        /// [`Format::denominator`] of the number's format: 1 except in normalized formats.
        den: u32,
    },
}

/// Decodes an operand: under [`Denormals::Flush`] a subnormal becomes a zero of its sign (or the only zero). Bits above
/// the width are ignored.
pub fn unpack(format: &Format, bits: u32) -> Unpacked {
    let bits = bits & format.mask();
    let sign = format.is_negative(bits);
    match format.kind {
        FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => {
            let sig = if sign { (1u64 << format.width()) - u64::from(bits) } else { u64::from(bits) };
            let exp = if let FormatKind::Fixed { frac_bits, .. } = format.kind { -i32::from(frac_bits) } else { 0 };
            Unpacked::Finite { sign, sig, exp, den: format.denominator() }
        }
        FormatKind::Float { exp_bits, man_bits } => {
            let field = (bits >> man_bits) & ((1 << exp_bits) - 1);
            let man = bits & ((1 << man_bits) - 1);
            if format.is_nan(bits) {
                // The NaN of an encoding with a single NaN is quiet.
                let quiet = format.encoding != Encoding::Ieee || man >> (man_bits - 1) != 0;
                return Unpacked::Nan { signaling: !quiet };
            }
            if format.is_infinite(bits) {
                return Unpacked::Inf { sign };
            }
            let (least, _) = format.exponents();
            let unit = least - i32::from(man_bits);
            if format.encoding == Encoding::Scale {
                return Unpacked::Finite { sign, sig: 1, exp: least + field.cast_signed(), den: 1 };
            }
            if field == 0 {
                let sig = if format.denormals == Denormals::Flush { 0 } else { u64::from(man) };
                let sign = sign && (sig != 0 || format.has_negative_zero());
                return Unpacked::Finite { sign, sig, exp: unit, den: 1 };
            }
            let sig = u64::from(man | 1 << man_bits);
            Unpacked::Finite { sign, sig, exp: unit + field.cast_signed() - 1, den: 1 }
        }
    }
}

/// Copies a value: NaN becomes canonical, and subnormals are flushed if the format flushes; raises nothing.
pub(crate) fn pass(format: &Format, bits: u32) -> u32 {
    let bits = bits & format.mask();
    if let FormatKind::Float { .. } = format.kind {
        if format.is_nan(bits) {
            return nan_bits(format);
        }
        if format.is_zero(bits) {
            return zero(format, format.is_negative(bits)).bits;
        }
    }
    bits
}

/// The canonical NaN, or zero where the format has none.
pub(crate) fn nan_bits(format: &Format) -> u32 {
    format.canonical_nan().unwrap_or(0)
}

/// A zero of the given sign. Fixed point and some floats have only one zero; scales have none, which is `INVALID`.
pub(crate) fn zero(format: &Format, sign: bool) -> Outcome {
    if !format.is_signed() {
        return invalid(format);
    }
    Outcome::exact(if sign && format.has_negative_zero() { format.sign_bit() } else { 0 })
}

/// The result of an operation without a real result: canonical NaN (fixed point: zero) and `INVALID`.
pub(crate) fn invalid(format: &Format) -> Outcome {
    Outcome::new(nan_bits(format), Flags::INVALID)
}

/// The result of an operation with a NaN operand: `INVALID` if one of them is signalling.
pub(crate) fn nan_result(format: &Format, operands: &[Unpacked]) -> Outcome {
    let signaling = operands.iter().any(|o| matches!(o, Unpacked::Nan { signaling: true }));
    Outcome::new(nan_bits(format), if signaling { Flags::INVALID } else { Flags::empty() })
}

/// An order-preserving integer for a pattern that isn't a NaN; both zeros give 0.
pub(crate) fn key(format: &Format, bits: u32) -> i64 {
    let bits = pass(format, bits);
    let negative = format.is_negative(bits);
    match format.kind {
        FormatKind::Fixed { .. } | FormatKind::Normalized { .. } if negative => {
            i64::from(bits) - (1i64 << format.width())
        }
        FormatKind::Float { .. } if negative => -i64::from(bits & (format.sign_bit() - 1)),
        _ => i64::from(bits),
    }
}
