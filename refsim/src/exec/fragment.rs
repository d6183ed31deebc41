//! Number formats and texels of OpenGL fragment programs, shared by the executors.

use std::ops::Range;

use crate::device::Rules;
use crate::isa::{Precision, RegisterFile, Version};
use crate::num::{Format, Overflow, Specials};
use crate::texture::TexelFormat;

/// Formats of the precision suffixes R, H and X.
///
/// Source: GL_NV_fragment_program. R is the device's register format, which is fp32 on cards with the extension. H is
/// the format of `_pp`, or fp16 with the extension's overflow rule on devices without `_pp`. X is fx12. All use the
/// device's rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FragmentFormats {
    /// Format of `R#`, `o[COLR]`, `o[DEPR]`, and interpolated values.
    pub full: Format,
    /// `H#`, `o[COLH]`.
    pub half: Format,
    /// Format of operations with suffix X; no register has this format.
    pub fixed: Format,
}

impl FragmentFormats {
    /// The formats of a device.
    pub fn new(rules: &Rules) -> Self {
        Self::of_registers(rules.format, rules.partial)
    }

    /// The formats for the given register format and format of `_pp` instructions.
    pub fn of_registers(format: Format, partial: Option<Format>) -> Self {
        let rounding = format.rounding;
        let half = Format::FP16.with_rounding(rounding).with_overflow(Overflow::Nv30).with_specials(Specials::Nv);
        Self { full: format, half: partial.unwrap_or(half), fixed: Format::FX12.with_rounding(rounding) }
    }

    /// The format of a precision.
    pub const fn of(&self, precision: Precision) -> Format {
        match precision {
            Precision::Full => self.full,
            Precision::Half => self.half,
            Precision::Fixed => self.fixed,
        }
    }

    /// The format of a register file.
    pub const fn of_file(&self, file: RegisterFile) -> Format {
        if file.is_half() { self.half } else { self.full }
    }
}

/// The components of a texel that a program of `version` reads as 0, independently of the sampler: in `!!FP1.0`, green
/// and blue if a float format does not store them, and all components of an unbound sampler.
///
/// Source: GL_NV_fragment_program, table X.5 and section 3.11.5.38. The table does not clearly cover other formats,
/// which keep Direct3D's defaults.
pub(crate) fn zero_components(version: Version, format: Option<TexelFormat>) -> Range<usize> {
    match format.map(TexelFormat::record) {
        _ if version != Version::Fp1_0 => 0..0,
        None => 0..4,
        Some(record) if record.is_float() => usize::from(record.channel_count.min(3))..3,
        Some(_) => 0..0,
    }
}
