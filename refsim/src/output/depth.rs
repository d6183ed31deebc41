//! Depth formats, comparisons and surfaces.

use std::cmp::Ordering;

use serde::Deserialize;
use strum::VariantArray;

use super::OutputError;
use crate::num::Format;
pub use crate::texel::DepthFormat;
use crate::texture::TargetRounding;
use crate::texture::value::{self, Exact};

impl DepthFormat {
    /// Encodes a depth given in number format `from`: clamped to [0, 1], rounded once. NaN gives 0.
    ///
    /// Patterns of a format are ordered like the depths that they encode. `rounding` applies to the fixed-point
    /// formats; the float formats round to nearest, ties to even.
    pub fn quantise(self, from: Format, bits: u32, rounding: TargetRounding) -> u32 {
        let (significand, exponent, denominator) = match value::exact(from, bits) {
            Exact::Nan | Exact::Infinite { negative: true } | Exact::Finite { negative: true, .. } => (0, 0, 1),
            Exact::Infinite { negative: false } => (1, 0, 1),
            Exact::Finite { significand, exponent, denominator, .. } => (significand, exponent, denominator),
        };
        let nearest = rounding == TargetRounding::Nearest;
        let unorm = |scale: u64| value::scaled_magnitude(significand, exponent, denominator, scale, nearest) as u32;
        // 32 bits of the quotient and a sticky bit: more than the float formats need.
        let (significand, exponent) = match u64::from(denominator) {
            1 => (significand, exponent),
            d => (((significand << 32) / d) | u64::from(!(significand << 32).is_multiple_of(d)), exponent - 32),
        };
        match self {
            Self::Unorm16 => unorm(0xffff),
            Self::Unorm24 => unorm(0x00ff_ffff),
            Self::Unorm32 => unorm(0xffff_ffff),
            Self::Float32 => positive_float(significand, exponent, 8, 23),
            Self::Float24 => positive_float(significand, exponent, 4, 20),
        }
    }

    /// Decodes a stored pattern into a number format, rounded once.
    pub fn to_format(self, stored: u32, format: Format) -> u32 {
        let ratio = |scale: u32| value::ratio(format, i64::from(stored.min(scale)), u64::from(scale));
        match self {
            Self::Unorm16 => ratio(0xffff),
            Self::Unorm24 => ratio(0x00ff_ffff),
            Self::Unorm32 => ratio(0xffff_ffff),
            Self::Float32 => crate::num::ops::convert(&Format::FP32, format, stored).bits,
            Self::Float24 => {
                let field = (stored >> 20 & 15).cast_signed();
                let fraction = u64::from(stored & 0x000f_ffff);
                let significand = if field == 0 { fraction } else { fraction | 1 << 20 };
                let exponent = field.max(1) - 15 - 20;
                crate::num::from_parts(format, false, u128::from(significand), exponent, false).bits
            }
        }
    }
}

impl std::str::FromStr for DepthFormat {
    type Err = OutputError;

    /// Parses this project's name or Direct3D's (`D24S8`, `D24X8`, `D16`, `D24FS8`, ...), in any case.
    fn from_str(text: &str) -> Result<Self, OutputError> {
        let lower = text.trim().to_ascii_lowercase();
        match lower.strip_prefix("d3dfmt_").unwrap_or(&lower) {
            "d16" => Ok(Self::Unorm16),
            "d24" | "d24s8" | "d24x8" => Ok(Self::Unorm24),
            "d32" => Ok(Self::Unorm32),
            "d32f" | "d32f_lockable" => Ok(Self::Float32),
            "d24f" | "d24fs8" => Ok(Self::Float24),
            _ => Err(OutputError::UnknownDepthFormat { name: text.chars().take(40).collect() }),
        }
    }
}

/// Encodes `min(significand * 2^exponent, 1)` as an unsigned float with bias `2^(exponent_bits-1) - 1` (8 exponent
/// bits) or 15 (4 exponent bits).
fn positive_float(significand: u64, exponent: i32, exponent_bits: u32, mantissa_bits: u32) -> u32 {
    let bias = if exponent_bits == 4 { 15 } else { (1 << (exponent_bits - 1)) - 1 };
    let one = (bias as u32) << mantissa_bits;
    if significand == 0 {
        return 0;
    }
    let top = exponent + 63 - significand.leading_zeros().cast_signed();
    if top >= 0 {
        return one;
    }
    // Unit in the last place of the number's binade, or of the subnormals.
    let unit = top.max(1 - bias) - mantissa_bits.cast_signed();
    let shift = unit - exponent;
    let kept = if shift <= 0 {
        significand << shift.unsigned_abs().min(31)
    } else if shift > 63 {
        0
    } else {
        let (whole, rest, half) = (significand >> shift, significand & ((1 << shift) - 1), 1u64 << (shift - 1));
        whole + u64::from(rest > half || (rest == half && whole & 1 == 1))
    };
    // Adding the hidden bit increments the exponent field, and so does a carry.
    let base = ((unit + mantissa_bits.cast_signed() + bias - 1) as u32) << mantissa_bits;
    (base + kept as u32).min(one)
}

/// Comparison of a new value with the stored value (or the alpha reference). Its discriminant is a bit set of the
/// orderings that pass: bit 0 less, bit 1 equal, bit 2 greater.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize, VariantArray)]
#[serde(rename_all = "kebab-case")]
pub enum CompareFunction {
    /// Never passes.
    Never,
    /// new < old
    Less,
    /// new = old
    Equal,
    /// new <= old
    LessEqual,
    /// new > old
    Greater,
    /// new is not old
    NotEqual,
    /// new >= old
    GreaterEqual,
    /// Always passes.
    #[default]
    Always,
}

impl CompareFunction {
    /// Every comparison.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Returns `true` for each order (less, equal, greater) that passes.
    pub(crate) const fn orders(self) -> [bool; 3] {
        let set = self as u8;
        [set & 1 != 0, set & 2 != 0, set & 4 != 0]
    }

    /// Returns `true` if the comparison passes. `None` is unordered (a NaN), which only `NotEqual` and `Always` pass.
    pub fn holds(self, order: Option<Ordering>) -> bool {
        let [less, equal, greater] = self.orders();
        match order {
            Some(Ordering::Less) => less,
            Some(Ordering::Equal) => equal,
            Some(Ordering::Greater) => greater,
            None => less && greater,
        }
    }
}

/// The state of the depth test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct DepthState {
    /// Comparison of the fragment's depth with the stored depth; `None` disables both the test and writes.
    pub test: Option<CompareFunction>,
    /// `true` if passing fragments write their depth.
    pub write: bool,
}

/// A depth buffer: one pattern of the format per pixel, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DepthSurface {
    format: DepthFormat,
    width: u32,
    height: u32,
    data: Vec<u32>,
}

impl DepthSurface {
    /// Creates a surface with depth 1, the far plane, everywhere.
    ///
    /// # Errors
    /// If an extent is 0 or above 16384.
    pub fn new(format: DepthFormat, width: u32, height: u32) -> Result<Self, OutputError> {
        if !(1..=16_384).contains(&width) || !(1..=16_384).contains(&height) {
            return Err(OutputError::DepthExtent { width, height });
        }
        let one = format.quantise(Format::FP32, value::ONE, TargetRounding::Nearest);
        Ok(Self { format, width, height, data: vec![one; width as usize * height as usize] })
    }

    /// The format.
    pub fn format(&self) -> DepthFormat {
        self.format
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Size in the card's memory, in bytes.
    pub fn bytes(&self) -> u64 {
        self.format.bytes() * u64::from(self.width) * u64::from(self.height)
    }

    /// All patterns, row by row.
    pub fn data(&self) -> &[u32] {
        &self.data
    }

    /// Mutable access to all patterns. Patterns beyond the format's width break the order of comparisons.
    pub fn data_mut(&mut self) -> &mut [u32] {
        &mut self.data
    }

    /// The pattern of a pixel; `None` outside the surface.
    pub fn get(&self, x: u32, y: u32) -> Option<u32> {
        let inside = x < self.width && y < self.height;
        inside.then(|| self.data[y as usize * self.width as usize + x as usize])
    }

    /// Fills the surface with a depth given as FP32 bits.
    pub fn clear(&mut self, depth: u32, rounding: TargetRounding) {
        self.data.fill(self.format.quantise(Format::FP32, depth, rounding));
    }
}
