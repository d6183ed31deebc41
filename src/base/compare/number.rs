//! Comparison of two numbers, possibly of two formats.

use std::cmp::Ordering;

use refsim::{
    num::{Format, FormatKind, power_of_two, to_f64},
    texture::{Channel, ChannelClass, SignedTexelMinimum, decode_channel},
};
use serde::Serialize;

use super::single::shortest;

/// Bit pattern with its format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Number {
    /// Format of the number.
    pub format: Format,
    /// Bit pattern of the number.
    pub bits: u32,
}

impl From<f32> for Number {
    fn from(value: f32) -> Self {
        Self { format: Format::FP32, bits: value.to_bits() }
    }
}

/// Pair of values, formatted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compared {
    /// Name of the value: `r0.x`, `target 0 red`.
    pub name: String,
    /// Left value in decimal.
    pub left: String,
    /// Bits of the left value, hexadecimal.
    pub left_bits: String,
    /// Right value in decimal.
    pub right: String,
    /// Bits of the right value, hexadecimal.
    pub right_bits: String,
    /// Distance in ULPs of the format `unit`; `None` if a value is not finite.
    pub ulps: Option<f64>,
    /// Format whose ULP is the unit of `ulps`.
    pub unit: String,
}

impl Number {
    /// Converts to a double exactly, for every number of every format; NaN and infinities stay NaN and infinities.
    pub fn double(&self) -> f64 {
        to_f64(&self.format, self.bits)
    }

    /// Returns `true` if two numbers are equal. Numbers with the same layout (sizes of the fields) are compared by
    /// bits, so 0 and -0 differ; numbers with different layouts are compared by value. NaN equals NaN.
    pub fn equals(&self, other: &Self) -> bool {
        if self.format.kind == other.format.kind {
            let nan = self.format.is_nan(self.bits) && other.format.is_nan(other.bits);
            return nan || self.bits == other.bits;
        }
        let (a, b) = (self.double(), other.double());
        a == b || (a.is_nan() && b.is_nan())
    }

    /// Formats in decimal, with enough digits to distinguish all numbers of all formats.
    pub fn decimal(&self) -> String {
        shortest(self.double())
    }

    /// Formats all bits of the format, hexadecimal.
    pub fn hex(&self) -> String {
        let digits = self.format.width().div_ceil(4) as usize;
        format!("0x{:0digits$x}", self.bits)
    }

    /// Unit in the last place at a magnitude: the distance from one number to the next.
    fn last_place(&self, magnitude: f64) -> f64 {
        match self.format.kind {
            FormatKind::Fixed { frac_bits, .. } => power_of_two(-i32::from(frac_bits)),
            FormatKind::Normalized { .. } => 1.0 / f64::from(self.format.denominator()),
            FormatKind::Float { man_bits, .. } => {
                let (least, most) = self.format.exponents();
                let exponent = ((magnitude.to_bits() >> 52) & 0x7ff) as i32 - 1023;
                power_of_two(exponent.clamp(least, most) - i32::from(man_bits))
            }
        }
    }

    /// Maps a number to an integer, so that neighbouring numbers of the layout differ by 1.
    fn step(&self) -> i64 {
        let bits = i64::from(self.bits & self.format.mask());
        match self.format.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } if self.format.is_negative(self.bits) => {
                bits - (1i64 << self.format.width())
            }
            FormatKind::Float { .. } if self.format.is_negative(self.bits) => i64::from(self.format.sign_bit()) - bits,
            _ => bits,
        }
    }
}

/// Distance between two numbers in ULPs, and the format of these ULPs; `None` if they are not equal and one is NaN or
/// infinite.
///
/// For numbers with the same layout, the distance is the number of steps between neighbouring numbers. For different
/// layouts, it is the exact difference, in ULPs of the format that is coarser at the larger magnitude.
pub fn ulps(left: &Number, right: &Number) -> (Option<f64>, Format) {
    let (a, b) = (left.double(), right.double());
    if (left.format.kind, left.format.encoding) == (right.format.kind, right.format.encoding) {
        let steps = left.step().abs_diff(right.step()) as f64;
        let known = (a.is_finite() && b.is_finite()) || left.equals(right);
        return (known.then_some(if left.equals(right) { 0.0 } else { steps }), left.format);
    }
    let magnitude = if a.abs() > b.abs() || b.is_nan() { a.abs() } else { b.abs() };
    let (of_left, of_right) = (left.last_place(magnitude), right.last_place(magnitude));
    let (unit, format) =
        if of_left.total_cmp(&of_right) == Ordering::Less { (of_right, right.format) } else { (of_left, left.format) };
    if left.equals(right) {
        return (Some(0.0), format);
    }
    let known = a.is_finite() && b.is_finite();
    (known.then(|| (a - b).abs() / unit), format)
}

impl Compared {
    /// Pair of register values.
    pub fn registers(name: impl Into<String>, left: &Number, right: &Number) -> Self {
        let (ulps, unit) = ulps(left, right);
        Self {
            name: name.into(),
            left: left.decimal(),
            left_bits: left.hex(),
            right: right.decimal(),
            right_bits: right.hex(),
            ulps,
            unit: unit.to_string(),
        }
    }

    /// Pair of truth values.
    pub fn truths(name: impl Into<String>, left: bool, right: bool) -> Self {
        let bits = |truth: bool| if truth { "0x1" } else { "0x0" }.to_owned();
        Self {
            name: name.into(),
            left: left.to_string(),
            left_bits: bits(left),
            right: right.to_string(),
            right_bits: bits(right),
            ulps: None,
            unit: "truth".to_owned(),
        }
    }

    /// Pair of stored values of one channel of two texels.
    pub(super) fn channels(name: impl Into<String>, channel: Channel, left: u32, right: u32) -> Self {
        if let ChannelClass::Float(format) = channel.class {
            let number = |bits| Number { format, bits };
            return Self::registers(name, &number(left), &number(right));
        }
        let hex = |bits: u32| format!("0x{bits:0digits$x}", digits = usize::from(channel.bits).div_ceil(4));
        Self {
            name: name.into(),
            left: shortest(channel_double(channel, left)),
            left_bits: hex(left),
            right: shortest(channel_double(channel, right)),
            right_bits: hex(right),
            ulps: Some(channel_steps(channel, left, right)),
            unit: format!("{} bits", channel.bits),
        }
    }
}

/// Value of a channel as a double; a normalised value is rounded once.
pub(super) fn channel_double(channel: Channel, bits: u32) -> f64 {
    decode_channel(channel, bits, SignedTexelMinimum::BelowMinusOne).to_f64()
}

/// Number of steps between two stored values of a normalised channel.
pub(super) fn channel_steps(channel: Channel, left: u32, right: u32) -> f64 {
    let spare = 32 - u32::from(channel.bits);
    let whole = |bits: u32| match channel.class {
        ChannelClass::Unorm => i64::from(bits),
        _ => i64::from((bits << spare).cast_signed() >> spare),
    };
    whole(left).abs_diff(whole(right)) as f64
}
