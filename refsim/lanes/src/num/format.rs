//! Number formats: layout and rules, and the bit patterns derived from them.

use serde::{Deserialize, Serialize};

use super::rules::{Denormals, Encoding, Overflow, Rounding, Specials, Unit};

/// A number format: a layout, and four rules that map an exact result to a representable one.
///
/// Written `s3.12`, `e5m10`, `fp24:rtz:ftz`; see [`FromStr`](std::str::FromStr) below and the module's documentation.
/// Fields may be changed freely as long as the layout stays within the ranges of [`FormatKind`]; an overflow rule that
/// the kind lacks (a float that wraps, a fixed-point infinity) acts as the kind's default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Format {
    /// The layout.
    pub kind: FormatKind,
    /// Encoding of infinities, NaN and zeros (floats).
    pub encoding: Encoding,
    /// Direction in which inexact results are rounded.
    pub rounding: Rounding,
    /// Treatment of results out of range.
    pub overflow: Overflow,
    /// Treatment of subnormal numbers (floats).
    pub denormals: Denormals,
    /// Conventions for NaN, infinity and domain errors (floats).
    pub specials: Specials,
    /// The arithmetic: the rules above, or the unit of a card.
    pub unit: Unit,
}

/// The layout of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FormatKind {
    /// Two's complement, `1 + int_bits + frac_bits` bits (at most 32), in units of `2^-frac_bits`: `sI.F`.
    Fixed {
        /// Integer bits without the sign.
        int_bits: u8,
        /// Fraction bits.
        frac_bits: u8,
    },
    /// Normalized integers: two's complement, `1 + int_bits + frac_bits` bits (at most 16), in units of
    /// `1 / (2^frac_bits - 1)`: `nI.F`. `n0.8` has the codes of an 8-bit texel channel, and their negatives.
    Normalized {
        /// Integer bits without the sign.
        int_bits: u8,
        /// Bits of the codes that represent 0 to 1: 2 to 8.
        frac_bits: u8,
    },
    /// Sign, biased exponent, stored mantissa as IEEE 754 lays them out: `eXmY`, `1 + X + Y` bits. [`Encoding::Scale`]
    /// has only the exponent: `e8m0`, 8 bits.
    Float {
        /// Exponent bits, 2 to 8 (7 in encodings without infinity); [`Encoding`] determines the bias, and the meaning
        /// of the largest field.
        exp_bits: u8,
        /// Stored mantissa bits, 1 to 23; the leading one is not stored.
        man_bits: u8,
    },
}

impl Format {
    /// PS 1.4 on R200, 1 sign, 3 integer and 12 fraction bits (alias `ps14`); range [-8, 8).
    pub const S3_12: Format = Format::fixed_unchecked(3, 12);
    /// NV30's 12-bit fixed point (alias `fx12`); range [-2, 2).
    pub const FX12: Format = Format::fixed_unchecked(1, 10);
    /// IEEE binary16 (alias `fp16`).
    pub const FP16: Format = Format::float_unchecked(5, 10);
    /// The 24-bit float of R300 (alias `fp24`).
    pub const FP24: Format = Format::float_unchecked(7, 16);
    /// IEEE binary32 (alias `fp32`).
    pub const FP32: Format = Format::float_unchecked(8, 23);
    /// The upper half of binary32 (alias `bf16`).
    pub const BF16: Format = Format::float_unchecked(8, 7);
    /// Powers of two, the scales of OCP's block formats: `e8m0`.
    pub const E8M0: Format = Format::float_unchecked(8, 0).with_encoding(Encoding::Scale);

    const fn fixed_unchecked(int_bits: u8, frac_bits: u8) -> Format {
        Format {
            kind: FormatKind::Fixed { int_bits, frac_bits },
            encoding: Encoding::Ieee,
            rounding: Rounding::NearestEven,
            overflow: Overflow::Saturate,
            denormals: Denormals::Keep,
            specials: Specials::Ieee,
            unit: Unit::Ideal,
        }
    }

    const fn float_unchecked(exp_bits: u8, man_bits: u8) -> Format {
        Format {
            kind: FormatKind::Float { exp_bits, man_bits },
            encoding: Encoding::Ieee,
            rounding: Rounding::NearestEven,
            overflow: Overflow::Infinity,
            denormals: Denormals::Keep,
            specials: Specials::Ieee,
            unit: Unit::Ideal,
        }
    }

    /// A fixed-point format with the default rules, or `None` if `int_bits + frac_bits` is 0 or above 31.
    pub const fn fixed(int_bits: u8, frac_bits: u8) -> Option<Format> {
        let total = int_bits as u32 + frac_bits as u32;
        if total >= 1 && total <= 31 { Some(Format::fixed_unchecked(int_bits, frac_bits)) } else { None }
    }

    /// A format of normalized integers with the default rules of fixed point, or `None` unless `frac_bits` is 2 to 8
    /// and `int_bits + frac_bits` at most 15.
    pub const fn normalized(int_bits: u8, frac_bits: u8) -> Option<Format> {
        if frac_bits >= 2 && frac_bits <= 8 && int_bits as u32 + frac_bits as u32 <= 15 {
            let mut format = Format::fixed_unchecked(int_bits, frac_bits);
            format.kind = FormatKind::Normalized { int_bits, frac_bits };
            Some(format)
        } else {
            None
        }
    }

    /// A float format with the default rules, or `None` unless there are 2 to 8 exponent bits and 1 to 23 mantissa
    /// bits.
    pub const fn float(exp_bits: u8, man_bits: u8) -> Option<Format> {
        if exp_bits >= 2 && exp_bits <= 8 && man_bits >= 1 && man_bits <= 23 {
            Some(Format::float_unchecked(exp_bits, man_bits))
        } else {
            None
        }
    }

    /// This layout with another encoding. [`Encoding::Finite`] and [`Encoding::UnsignedZero`] require at most 7
    /// exponent bits, so that single precision represents every number; [`Encoding::Scale`] requires [`Format::E8M0`].
    pub const fn with_encoding(mut self, encoding: Encoding) -> Format {
        self.encoding = encoding;
        self
    }

    /// This format with another rounding.
    pub const fn with_rounding(mut self, rounding: Rounding) -> Format {
        self.rounding = rounding;
        self
    }

    /// This format with another overflow rule.
    pub const fn with_overflow(mut self, overflow: Overflow) -> Format {
        self.overflow = overflow;
        self
    }

    /// This format with or without subnormal numbers.
    pub const fn with_denormals(mut self, denormals: Denormals) -> Format {
        self.denormals = denormals;
        self
    }

    /// This format with other conventions for special values.
    pub const fn with_specials(mut self, specials: Specials) -> Format {
        self.specials = specials;
        self
    }

    /// This format, computed by the unit of a card, which flushes subnormal numbers; for [`Format::FP32`] only.
    pub const fn with_unit(mut self, unit: Unit) -> Format {
        self.unit = unit;
        if unit.is_card() {
            self.denormals = Denormals::Flush;
        }
        self
    }

    /// Returns `true` if a conversion from `from` keeps the pattern: from single floats to the unit of a card.
    #[inline]
    pub fn takes_patterns_of(&self, from: &Format) -> bool {
        self.unit.is_card() && from.kind == Self::FP32.kind && from.encoding == Encoding::Ieee
    }

    /// Returns `true` for fixed-point and normalized formats: a pattern is a two's complement integer in units of the
    /// format, with one zero, no infinity and no NaN.
    #[inline]
    pub const fn is_fixed(&self) -> bool {
        !matches!(self.kind, FormatKind::Float { .. })
    }

    /// The odd part of the numbers' denominator: every number is an integer times a power of two, divided by this.
    /// `2^frac_bits - 1` in normalized formats, else 1.
    #[inline]
    pub const fn denominator(&self) -> u32 {
        match self.kind {
            FormatKind::Normalized { frac_bits, .. } => (1 << frac_bits) - 1,
            FormatKind::Fixed { .. } | FormatKind::Float { .. } => 1,
        }
    }

    /// Width in bits, 2 to 32.
    #[inline]
    pub const fn width(&self) -> u32 {
        match self.kind {
            FormatKind::Fixed { int_bits, frac_bits } | FormatKind::Normalized { int_bits, frac_bits } => {
                1 + int_bits as u32 + frac_bits as u32
            }
            FormatKind::Float { exp_bits, man_bits } => self.is_signed() as u32 + exp_bits as u32 + man_bits as u32,
        }
    }

    /// Returns `true` if the format has negative numbers: all but [`Format::E8M0`].
    #[inline]
    pub const fn is_signed(&self) -> bool {
        !matches!(self.encoding, Encoding::Scale)
    }

    /// Returns `true` if there are two zeros.
    #[inline]
    pub const fn has_negative_zero(&self) -> bool {
        !self.is_fixed() && matches!(self.encoding, Encoding::Ieee | Encoding::Finite)
    }

    /// Returns `true` if a float has a pattern that means NaN.
    const fn has_nan(&self) -> bool {
        !(self.is_fixed() || matches!(self.encoding, Encoding::Finite) && self.width() <= 6)
    }

    /// Exponents of the smallest normal and of the largest finite number; `(0, 0)` in fixed point.
    #[inline]
    pub const fn exponents(&self) -> (i32, i32) {
        let FormatKind::Float { exp_bits, .. } = self.kind else { return (0, 0) };
        let half = 1 << (exp_bits - 1);
        match self.encoding {
            Encoding::Ieee => (2 - half, half - 1),
            Encoding::Finite => (2 - half, half),
            Encoding::UnsignedZero => (1 - half, half - 1),
            Encoding::Scale => (1 - half, half - 1),
        }
    }

    /// Returns `true` if every number of another format, with its infinities, NaN and negative zero, is also a number
    /// of this format, so that conversion to this format and back changes nothing. Subnormals of a format with `:ftz`
    /// do not count as its numbers.
    pub fn holds(self, other: Self) -> bool {
        use FormatKind::{Fixed, Float, Normalized};
        let least = |exponent: i32, digits: u8, denormals: Denormals| match denormals {
            Denormals::Keep => exponent - i32::from(digits),
            Denormals::Flush => exponent,
        };
        match (self.kind, other.kind) {
            (Fixed { int_bits, frac_bits }, Fixed { int_bits: int, frac_bits: frac }) => {
                int_bits >= int && frac_bits >= frac
            }
            (Normalized { int_bits, frac_bits }, Normalized { int_bits: int, frac_bits: frac }) => {
                int_bits >= int && frac_bits == frac
            }
            (Float { man_bits, .. }, Fixed { int_bits, frac_bits }) => {
                let (normal, largest) = self.exponents();
                // The most negative number, -2^I, is a power of two.
                i32::from(int_bits + frac_bits) <= i32::from(man_bits) + 1
                    && i32::from(int_bits) <= largest
                    && -i32::from(frac_bits) >= least(normal, man_bits, self.denormals)
            }
            (Float { man_bits, .. }, Float { man_bits: digits, .. }) => {
                let ((normal, largest), (its_normal, its_largest)) = (self.exponents(), other.exponents());
                let smallest = least(its_normal, digits, other.denormals);
                man_bits >= digits
                    && (largest > its_largest || largest == its_largest && self.reaches(other))
                    && smallest >= least(normal, man_bits, self.denormals)
                    && (self.infinity(false).is_some() || other.infinity(false).is_none())
                    && (self.has_nan() || !other.has_nan())
                    && (self.has_negative_zero() || !other.has_negative_zero())
            }
            _ => false,
        }
    }

    /// Returns `true` if this float's largest number is at least the other's; both have the same largest exponent.
    fn reaches(self, other: Self) -> bool {
        let digits = |format: Self| match format.kind {
            FormatKind::Float { man_bits, .. } => (format.max_finite() & ((1 << man_bits) - 1)) << (23 - man_bits),
            _ => 0,
        };
        digits(self) >= digits(other)
    }

    /// Bit mask of the width.
    #[inline]
    pub const fn mask(&self) -> u32 {
        u32::MAX >> (32 - self.width())
    }

    /// The sign bit. [`Format::E8M0`] has no sign: there it is the bit above the width.
    #[inline]
    pub const fn sign_bit(&self) -> u32 {
        1 << (self.width() - self.is_signed() as u32)
    }

    /// Positive zero.
    pub const fn zero(&self) -> u32 {
        0
    }

    /// Code of the number 1. `s0.F` cannot represent 1: there it is the code of the largest number.
    pub const fn one(&self) -> u32 {
        match self.kind {
            FormatKind::Fixed { int_bits: 0, .. } => self.max_finite(),
            FormatKind::Fixed { frac_bits, .. } => 1 << frac_bits,
            FormatKind::Normalized { .. } => self.denominator(),
            FormatKind::Float { exp_bits, man_bits } => {
                let bias = (1 << (exp_bits - 1)) - !matches!(self.encoding, Encoding::UnsignedZero) as u32;
                bias << man_bits
            }
        }
    }

    /// The largest finite number.
    pub const fn max_finite(&self) -> u32 {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => self.sign_bit() - 1,
            FormatKind::Float { man_bits, .. } => match self.encoding {
                Encoding::Ieee => self.sign_bit() - 1 - (1 << man_bits),
                Encoding::Finite => self.sign_bit() - 1 - self.has_nan() as u32,
                Encoding::UnsignedZero => self.sign_bit() - 1,
                Encoding::Scale => self.sign_bit() - 2,
            },
        }
    }

    /// The most negative finite number; in [`Format::E8M0`] the smallest.
    pub const fn min_finite(&self) -> u32 {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => self.sign_bit(),
            FormatKind::Float { .. } => (self.sign_bit() | self.max_finite()) * self.is_signed() as u32,
        }
    }

    /// The largest or the most negative finite number.
    pub const fn extreme(&self, negative: bool) -> u32 {
        if negative { self.min_finite() } else { self.max_finite() }
    }

    /// The pattern of an infinity; `None` in fixed point and in encodings without one.
    #[inline]
    pub const fn infinity(&self, negative: bool) -> Option<u32> {
        match (self.kind, self.encoding) {
            (FormatKind::Float { man_bits, .. }, Encoding::Ieee) => {
                let inf = self.sign_bit() - (1 << man_bits);
                Some(if negative { inf | self.sign_bit() } else { inf })
            }
            _ => None,
        }
    }

    /// The NaN that operations return: positive, quiet, rest of the payload zero; or the encoding's only NaN. In units
    /// of cards all bits but the sign are set. `None` in fixed point and in finite floats of at most 6 bits.
    pub const fn canonical_nan(&self) -> Option<u32> {
        match (self.kind, self.encoding) {
            _ if self.unit.is_card() => Some(self.sign_bit() - 1),
            (FormatKind::Float { man_bits, .. }, Encoding::Ieee) => {
                Some((self.sign_bit() - (1 << man_bits)) | (1 << (man_bits - 1)))
            }
            (FormatKind::Float { .. }, Encoding::UnsignedZero) => Some(self.sign_bit()),
            (FormatKind::Float { .. }, _) if self.has_nan() => Some(self.sign_bit() - 1),
            _ => None,
        }
    }

    /// Returns `true` if the pattern is a NaN. Bits above the width are ignored.
    #[inline]
    pub const fn is_nan(&self, bits: u32) -> bool {
        let magnitude = bits & (self.sign_bit() - 1);
        match (self.kind, self.encoding) {
            (FormatKind::Float { man_bits, .. }, Encoding::Ieee) => magnitude > self.sign_bit() - (1 << man_bits),
            (FormatKind::Float { .. }, Encoding::UnsignedZero) => bits & self.mask() == self.sign_bit(),
            (FormatKind::Float { .. }, _) => self.has_nan() && magnitude == self.sign_bit() - 1,
            _ => false,
        }
    }

    /// Returns `true` if the pattern is an infinity.
    #[inline]
    pub const fn is_infinite(&self, bits: u32) -> bool {
        match self.infinity(false) {
            Some(infinity) => bits & (self.sign_bit() - 1) == infinity,
            None => false,
        }
    }

    /// Returns `true` if the pattern is a finite number.
    pub const fn is_finite(&self, bits: u32) -> bool {
        !self.is_nan(bits) && !self.is_infinite(bits)
    }

    /// Returns `true` if the sign bit is set (a negative number, -0, or a negative NaN).
    #[inline]
    pub const fn is_negative(&self, bits: u32) -> bool {
        bits & self.mask() & self.sign_bit() != 0
    }

    /// Returns `true` if operations treat the pattern as zero: a zero of either sign, or a subnormal of a flushing
    /// format.
    #[inline]
    pub const fn is_zero(&self, bits: u32) -> bool {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => bits & self.mask() == 0,
            FormatKind::Float { .. } => {
                let magnitude = bits & (self.sign_bit() - 1);
                let zero = magnitude == 0 && self.is_signed() && !self.is_nan(bits);
                zero || (self.is_subnormal(bits) && matches!(self.denormals, Denormals::Flush))
            }
        }
    }

    /// Returns `true` if the pattern is a subnormal float, under any denormal rule.
    #[inline]
    pub const fn is_subnormal(&self, bits: u32) -> bool {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => false,
            FormatKind::Float { man_bits, .. } => {
                let magnitude = bits & (self.sign_bit() - 1);
                magnitude != 0 && magnitude < (1 << man_bits)
            }
        }
    }
}
