//! Field layout of the float formats.

use crate::num::{Denormals, Encoding, Format};

/// `2^e`; `e` must be the exponent of a normal double.
#[inline(always)]
pub(crate) fn pow2(e: i32) -> f64 {
    f64::from_bits(((e + 1023) as u64) << 52)
}

/// Field layout of a float format, and derived quantities.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FloatLayout {
    man_bits: u32,
    exp_bits: u32,
    bias: i32,
    /// `true` if the largest exponent field encodes infinity and NaN.
    ieee: bool,
    /// For other encodings: the bits that identify NaN, their value in NaN, and the pattern with which NaN is written.
    nan_mask: u32,
    nan: u32,
    canonical_nan: u32,
    /// `true` if zero has no sign.
    one_zero: bool,
    pub(crate) min_normal: f64,
    /// `2^-man_bits`: the unit in the last place, relative to the binade's power of two.
    pub(crate) unit: f64,
    /// `true` if subnormal patterns are read as zero.
    flushes: bool,
}

impl FloatLayout {
    /// The layout of a format with these field widths.
    pub(crate) fn new(format: &Format, exp_bits: u8, man_bits: u8) -> Self {
        let (least, _) = format.exponents();
        let sign = format.sign_bit();
        let (nan_mask, nan) = match (format.canonical_nan(), format.encoding) {
            (Some(nan), Encoding::UnsignedZero) => (format.mask(), nan),
            (Some(nan), _) => (sign - 1, nan),
            (None, _) => (0, u32::MAX),
        };
        Self {
            man_bits: man_bits.into(),
            exp_bits: exp_bits.into(),
            bias: 1 - least,
            ieee: format.encoding == Encoding::Ieee,
            nan_mask,
            nan,
            canonical_nan: format.canonical_nan().unwrap_or(0),
            one_zero: !format.has_negative_zero(),
            min_normal: pow2(least),
            unit: pow2(-i32::from(man_bits)),
            flushes: format.denormals == Denormals::Flush,
        }
    }

    #[inline(always)]
    pub(crate) fn decode(&self, bits: u32) -> f32 {
        let (m, x) = (self.man_bits, self.exp_bits);
        let sign = (bits >> (m + x) & 1) << 31;
        let magnitude = bits & ((1 << (m + x)) - 1);
        let field = magnitude >> m;
        let man = magnitude & ((1 << m) - 1);
        if self.ieee && field == (1 << x) - 1 {
            return if man == 0 { f32::from_bits(sign | 0x7f80_0000) } else { f32::NAN };
        }
        if !self.ieee && bits & self.nan_mask == self.nan {
            return f32::NAN;
        }
        let value = if field == 0 {
            if self.flushes { 0.0 } else { f64::from(man) * self.min_normal * self.unit }
        } else {
            f64::from(man | 1 << m) * self.unit * pow2(field.cast_signed() - self.bias)
        };
        let sign = if self.one_zero && value == 0.0 { 0 } else { sign };
        f32::from_bits((value as f32).to_bits() | sign)
    }

    /// Encodes a number of the format; NaN becomes the canonical one.
    #[inline(always)]
    pub(crate) fn encode(&self, x: f32) -> u32 {
        let (m, w) = (self.man_bits, self.man_bits + self.exp_bits);
        let sign = u32::from(x.is_sign_negative()) << w;
        let infinity = ((1 << self.exp_bits) - 1) << m;
        if x.is_nan() {
            return self.canonical_nan;
        }
        if x.is_infinite() {
            return sign | infinity;
        }
        let mag = f64::from(x).abs();
        if mag < self.min_normal {
            return sign | (mag / (self.min_normal * self.unit)) as u32;
        }
        let bits = mag.to_bits();
        let field = ((bits >> 52).cast_signed() - 1023 + i64::from(self.bias)) as u32;
        sign | field << m | (bits << 12 >> 12 >> (52 - m)) as u32
    }
}
