//! Number formats: layout and rules, and the bit patterns derived from them.

use serde::{Deserialize, Serialize};

/// A number format: a layout, and four rules that map an exact result to a representable one.
///
/// Written `s3.12`, `e5m10`, `fp24:rtz:ftz`; see [`FromStr`](std::str::FromStr) below and the room's essay.
/// Fields may be changed freely as long as the layout stays within the ranges of [`FormatKind`]; a rule that has no
/// meaning for the kind (a float that wraps, a fixed-point infinity) acts as the kind's default overflow rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Format {
    /// The layout.
    pub kind: FormatKind,
    /// Direction in which inexact results are rounded.
    pub rounding: Rounding,
    /// Treatment of results out of range.
    pub overflow: Overflow,
    /// Treatment of subnormal numbers (floats).
    pub denormals: Denormals,
    /// Conventions for NaN, infinity and domain errors (floats).
    pub specials: Specials,
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
        /// Bits of the codes from 0 to 1, 2 to 8.
        frac_bits: u8,
    },
    /// Sign, biased exponent, stored mantissa as IEEE 754 lays them out: `eXmY`, `1 + X + Y` bits.
    Float {
        /// Exponent bits, 2 to 8; the bias is `2^(X-1) - 1` and the largest field means infinity or NaN.
        exp_bits: u8,
        /// Stored mantissa bits, 1 to 23; the leading one is not stored.
        man_bits: u8,
    },
}

/// Direction in which inexact results are rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rounding {
    /// To the nearest, ties to the even pattern (`:rne`).
    NearestEven,
    /// To the nearest, ties away from zero (`:rna`).
    NearestAway,
    /// Truncation of the magnitude (`:rtz`).
    TowardZero,
    /// Toward minus infinity (`:rdn`): the effect of dropping low bits of a two's complement product.
    Down,
}

/// Treatment of results out of range.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Overflow {
    /// The nearest end of the range (`:sat`). A float with this rule makes no infinity from finite operands at
    /// all: division by zero and `log2 0` give the largest finite number too (Direct3D's `log(0) = -FLT_MAX`).
    Saturate,
    /// Modulo the width (`:wrap`), fixed point only. Results that are exactly infinite, and overflowing
    /// exponentials, have no residue and saturate.
    Wrap,
    /// IEEE 754 (`:inf`): infinity or the largest finite number, as the rounding direction asks. Floats only.
    Infinity,
    /// `NV_fragment_program` (`:nvovf`): exact magnitudes of `2^(emax+1)` and more become infinity, smaller ones
    /// at most the largest finite number, in every rounding direction. Floats only.
    Nv30,
}

/// Treatment of subnormal numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Denormals {
    /// Gradual underflow (`:keep`).
    Keep,
    /// Subnormal operands count as zero, and a result whose rounded value is subnormal becomes zero (`:ftz`). The
    /// sign is kept. A flushed result raises `UNDERFLOW` and `INEXACT`; a flushed operand raises nothing.
    Flush,
}

/// Conventions for NaN, infinity and domain errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Specials {
    /// Direct3D 9 on IEEE 754 values (`:ieee`): `min` is `a < b ? a : b` and `max` is `a >= b ? a : b`, so a NaN
    /// in either place gives `b`; `rsq`, `log2` and `pow` take the magnitude of their operand.
    Ieee,
    /// `NV_fragment_program` (`:nv`): `min`/`max` with a NaN give NaN; `rsq(-0)` is -inf; `rsq` and `log2` of a
    /// negative number are NaN.
    Nv,
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

    const fn fixed_unchecked(int_bits: u8, frac_bits: u8) -> Format {
        Format {
            kind: FormatKind::Fixed { int_bits, frac_bits },
            rounding: Rounding::NearestEven,
            overflow: Overflow::Saturate,
            denormals: Denormals::Keep,
            specials: Specials::Ieee,
        }
    }

    const fn float_unchecked(exp_bits: u8, man_bits: u8) -> Format {
        Format {
            kind: FormatKind::Float { exp_bits, man_bits },
            rounding: Rounding::NearestEven,
            overflow: Overflow::Infinity,
            denormals: Denormals::Keep,
            specials: Specials::Ieee,
        }
    }

    /// A fixed-point format with the default rules, or `None` if `int_bits + frac_bits` is 0 or above 31.
    pub const fn fixed(int_bits: u8, frac_bits: u8) -> Option<Format> {
        let total = int_bits as u32 + frac_bits as u32;
        if total >= 1 && total <= 31 { Some(Format::fixed_unchecked(int_bits, frac_bits)) } else { None }
    }

    /// A format of normalized integers with the default rules of fixed point, or `None` if `frac_bits` is not within 2
    /// to 8 or `int_bits + frac_bits` is above 15.
    pub const fn normalized(int_bits: u8, frac_bits: u8) -> Option<Format> {
        if frac_bits >= 2 && frac_bits <= 8 && int_bits as u32 + frac_bits as u32 <= 15 {
            let mut format = Format::fixed_unchecked(int_bits, frac_bits);
            format.kind = FormatKind::Normalized { int_bits, frac_bits };
            Some(format)
        } else {
            None
        }
    }

    /// A float format with the default rules, or `None` outside exponent 2 to 8 and mantissa 1 to 23 bits.
    pub const fn float(exp_bits: u8, man_bits: u8) -> Option<Format> {
        if exp_bits >= 2 && exp_bits <= 8 && man_bits >= 1 && man_bits <= 23 {
            Some(Format::float_unchecked(exp_bits, man_bits))
        } else {
            None
        }
    }

    /// The same format with another rounding.
    pub const fn with_rounding(mut self, rounding: Rounding) -> Format {
        self.rounding = rounding;
        self
    }

    /// The same format with another overflow rule.
    pub const fn with_overflow(mut self, overflow: Overflow) -> Format {
        self.overflow = overflow;
        self
    }

    /// The same format with or without subnormal numbers.
    pub const fn with_denormals(mut self, denormals: Denormals) -> Format {
        self.denormals = denormals;
        self
    }

    /// The same format with other conventions for special values.
    pub const fn with_specials(mut self, specials: Specials) -> Format {
        self.specials = specials;
        self
    }

    /// Returns `true` for fixed-point formats, normalized ones among them: a pattern is a two's complement integer in
    /// units of the format, and there is one zero, no infinity and no NaN.
    pub const fn is_fixed(&self) -> bool {
        !matches!(self.kind, FormatKind::Float { .. })
    }

    /// The odd part of what numbers are divided by: every number is an integer times a power of two, over this.
    /// `2^frac_bits - 1` in normalized formats, else 1.
    pub const fn denominator(&self) -> u32 {
        match self.kind {
            FormatKind::Normalized { frac_bits, .. } => (1 << frac_bits) - 1,
            FormatKind::Fixed { .. } | FormatKind::Float { .. } => 1,
        }
    }

    /// Width in bits, 2 to 32.
    pub const fn width(&self) -> u32 {
        match self.kind {
            FormatKind::Fixed { int_bits, frac_bits } | FormatKind::Normalized { int_bits, frac_bits } => {
                1 + int_bits as u32 + frac_bits as u32
            }
            FormatKind::Float { exp_bits, man_bits } => 1 + exp_bits as u32 + man_bits as u32,
        }
    }

    /// Bit mask of the width.
    pub const fn mask(&self) -> u32 {
        u32::MAX >> (32 - self.width())
    }

    /// The sign bit.
    pub const fn sign_bit(&self) -> u32 {
        1 << (self.width() - 1)
    }

    /// Positive zero.
    pub const fn zero(&self) -> u32 {
        0
    }

    /// One; in `s0.F`, which has none, the largest number.
    pub const fn one(&self) -> u32 {
        match self.kind {
            FormatKind::Fixed { int_bits: 0, .. } => self.max_finite(),
            FormatKind::Fixed { frac_bits, .. } => 1 << frac_bits,
            FormatKind::Normalized { .. } => self.denominator(),
            FormatKind::Float { exp_bits, man_bits } => ((1 << (exp_bits - 1)) - 1) << man_bits,
        }
    }

    /// The largest finite number.
    pub const fn max_finite(&self) -> u32 {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => self.sign_bit() - 1,
            FormatKind::Float { man_bits, .. } => self.sign_bit() - 1 - (1 << man_bits),
        }
    }

    /// The most negative finite number.
    pub const fn min_finite(&self) -> u32 {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => self.sign_bit(),
            FormatKind::Float { .. } => self.sign_bit() | self.max_finite(),
        }
    }

    /// The end of the finite range on the given side.
    pub const fn extreme(&self, negative: bool) -> u32 {
        if negative { self.min_finite() } else { self.max_finite() }
    }

    /// The pattern of an infinity; `None` in fixed point.
    pub const fn infinity(&self, negative: bool) -> Option<u32> {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => None,
            FormatKind::Float { man_bits, .. } => {
                let inf = self.sign_bit() - (1 << man_bits);
                Some(if negative { inf | self.sign_bit() } else { inf })
            }
        }
    }

    /// The NaN that operations return: positive, quiet, rest of the payload zero. `None` in fixed point.
    pub const fn canonical_nan(&self) -> Option<u32> {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => None,
            FormatKind::Float { man_bits, .. } => Some((self.sign_bit() - (1 << man_bits)) | (1 << (man_bits - 1))),
        }
    }

    /// Returns `true` if the pattern is a NaN. Bits above the width are ignored.
    pub const fn is_nan(&self, bits: u32) -> bool {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => false,
            FormatKind::Float { man_bits, .. } => {
                let magnitude = bits & (self.sign_bit() - 1);
                magnitude > self.sign_bit() - (1 << man_bits)
            }
        }
    }

    /// Returns `true` if the pattern is an infinity.
    pub const fn is_infinite(&self, bits: u32) -> bool {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => false,
            FormatKind::Float { man_bits, .. } => bits & (self.sign_bit() - 1) == self.sign_bit() - (1 << man_bits),
        }
    }

    /// Returns `true` if the pattern is a finite number.
    pub const fn is_finite(&self, bits: u32) -> bool {
        !self.is_nan(bits) && !self.is_infinite(bits)
    }

    /// Returns `true` if the sign bit is set (a negative number, -0, or a negative NaN).
    pub const fn is_negative(&self, bits: u32) -> bool {
        bits & self.sign_bit() != 0
    }

    /// Returns `true` if operations treat the pattern as zero: either zero, or a subnormal of a flushing format.
    pub const fn is_zero(&self, bits: u32) -> bool {
        match self.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => bits & self.mask() == 0,
            FormatKind::Float { .. } => {
                let magnitude = bits & (self.sign_bit() - 1);
                magnitude == 0 || (self.is_subnormal(bits) && matches!(self.denormals, Denormals::Flush))
            }
        }
    }

    /// Returns `true` if the pattern is a subnormal float, whatever the denormal rule.
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
