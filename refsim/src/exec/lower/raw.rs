//! Raw values: representation of numbers of any format in 32 bits in `batch` and `wgsl`.
//!
//! A fixed-point number, normalized or not, is a sign-extended two's complement integer. A float is the binary32
//! pattern of the same number, which exists for every format; NaN is always `0x7fc0_0000`.

use crate::num::{Denormals, Format, FormatKind};

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
    /// Smallest normal number.
    pub(crate) min_normal: f64,
    /// `2^-man_bits`: a binade's power of two times this is its unit in the last place.
    pub(crate) unit: f64,
    /// `true` if subnormal patterns are read as zero.
    flushes: bool,
}

impl FloatLayout {
    /// The layout of a format with these field widths.
    pub(crate) fn new(exp_bits: u8, man_bits: u8, denormals: Denormals) -> Self {
        Self {
            man_bits: man_bits.into(),
            exp_bits: exp_bits.into(),
            min_normal: pow2(2 - (1 << (exp_bits - 1))),
            unit: pow2(-i32::from(man_bits)),
            flushes: denormals == Denormals::Flush,
        }
    }

    /// Decodes a bit pattern.
    #[inline(always)]
    pub(crate) fn decode(&self, bits: u32) -> f32 {
        let (m, x) = (self.man_bits, self.exp_bits);
        let sign = (bits >> (m + x) & 1) << 31;
        let magnitude = bits & ((1 << (m + x)) - 1);
        let field = magnitude >> m;
        let man = magnitude & ((1 << m) - 1);
        if field == (1 << x) - 1 {
            return if man == 0 { f32::from_bits(sign | 0x7f80_0000) } else { f32::NAN };
        }
        let value = if field == 0 {
            if self.flushes { 0.0 } else { f64::from(man) * self.min_normal * self.unit }
        } else {
            f64::from(man | 1 << m) * self.unit * pow2(field.cast_signed() + 1 - (1 << (x - 1)))
        };
        f32::from_bits((value as f32).to_bits() | sign)
    }

    /// Encodes a number of the format; NaN becomes the canonical one.
    #[inline(always)]
    pub(crate) fn encode(&self, x: f32) -> u32 {
        let (m, w) = (self.man_bits, self.man_bits + self.exp_bits);
        let sign = u32::from(x.is_sign_negative()) << w;
        let infinity = ((1 << self.exp_bits) - 1) << m;
        if x.is_nan() {
            return infinity | 1 << (m - 1);
        }
        if x.is_infinite() {
            return sign | infinity;
        }
        let mag = f64::from(x).abs();
        if mag < self.min_normal {
            return sign | (mag / (self.min_normal * self.unit)) as u32;
        }
        let bits = mag.to_bits();
        let bias = (1i64 << (self.exp_bits - 1)) - 1;
        let field = ((bits >> 52).cast_signed() - 1023 + bias) as u32;
        sign | field << m | (bits << 12 >> 12 >> (52 - m)) as u32
    }
}

/// Converts a bit pattern of a format to a raw value.
pub(super) fn decode(format: &Format, bits: u32) -> u32 {
    match format.kind {
        FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => {
            let spare = 32 - format.width();
            (bits.cast_signed() << spare >> spare).cast_unsigned()
        }
        FormatKind::Float { exp_bits, man_bits } => {
            FloatLayout::new(exp_bits, man_bits, format.denormals).decode(bits).to_bits()
        }
    }
}

/// Converts a raw value to a bit pattern.
pub(super) fn encode(format: &Format, raw: u32) -> u32 {
    match format.kind {
        FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => raw & format.mask(),
        FormatKind::Float { exp_bits, man_bits } => {
            FloatLayout::new(exp_bits, man_bits, format.denormals).encode(f32::from_bits(raw))
        }
    }
}
