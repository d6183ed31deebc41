//! Decoding and encoding of texels: decoding is exact, and values are rounded once when written to a register or a
//! target.

use super::value::{self, Exact};
use super::{SignedTexelMinimum, TargetRounding, TexelFormat};
use crate::num::{self, Format};
use crate::texel::{Channel, ChannelClass, ComponentSource};

/// Exact value of a texel component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChannelValue {
    /// `numerator / denominator`, not reduced; the channel determines the denominator.
    Ratio {
        /// At most 32 bits in magnitude.
        numerator: i64,
        /// At least 1.
        denominator: u32,
    },
    /// A bit pattern of a floating-point format.
    Float {
        /// The format.
        format: Format,
        /// The pattern.
        bits: u32,
    },
}

impl ChannelValue {
    /// The constant 0.
    pub const ZERO: Self = Self::Ratio { numerator: 0, denominator: 1 };
    /// The constant 1.
    pub const ONE: Self = Self::Ratio { numerator: 1, denominator: 1 };

    /// Rounds the value once into `format`.
    pub fn to_format(self, format: Format) -> u32 {
        match self {
            Self::Ratio { numerator, denominator } => value::ratio(format, numerator, u64::from(denominator)),
            Self::Float { format: from, bits } => num::ops::convert(&from, format, bits).bits,
        }
    }
}

/// Exact red, green, blue and alpha of a texel, with defaults for components that are not stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Texel(pub [ChannelValue; 4]);

impl Texel {
    /// Rounds the four values once into `format`.
    pub fn to_format(self, format: Format) -> [u32; 4] {
        self.0.map(|c| c.to_format(format))
    }
}

impl Channel {
    /// The channel's stored code in a texel that is read as a little-endian integer.
    pub fn code(self, raw: u128) -> u32 {
        (raw >> self.shift) as u32 & mask(self.bits)
    }
}

fn mask(bits: u8) -> u32 {
    if bits >= 32 { u32::MAX } else { (1 << bits) - 1 }
}

/// Denominator of a channel's values: `2^n - 1`, `2^(n-1) - 1`, or 240 for `SplitSnorm`.
pub(crate) fn denominator(channel: Channel) -> u32 {
    match channel.class {
        ChannelClass::Unorm => mask(channel.bits),
        ChannelClass::Snorm => mask(channel.bits - 1).max(1),
        ChannelClass::SplitSnorm => 240,
        ChannelClass::Float(_) => 1,
    }
}

/// Decodes the bits of one channel exactly.
pub fn decode_channel(channel: Channel, bits: u32, minimum: SignedTexelMinimum) -> ChannelValue {
    let bits = bits & mask(channel.bits);
    let denominator = denominator(channel);
    let spare = 32 - u32::from(channel.bits);
    let signed = i64::from((bits << spare).cast_signed() >> spare);
    let numerator = match channel.class {
        ChannelClass::Unorm => i64::from(bits),
        ChannelClass::Snorm => match minimum {
            SignedTexelMinimum::Clamp => signed.max(-i64::from(denominator)),
            SignedTexelMinimum::BelowMinusOne => signed,
        },
        // k/15 above and k/16 below zero, over their common denominator.
        ChannelClass::SplitSnorm => signed * if signed < 0 { 15 } else { 16 },
        ChannelClass::Float(format) => return ChannelValue::Float { format, bits },
    };
    ChannelValue::Ratio { numerator, denominator }
}

/// Decodes a texel, given as a little-endian integer, exactly.
pub fn decode(format: TexelFormat, raw: u128, minimum: SignedTexelMinimum) -> Texel {
    let record = format.record();
    Texel(record.components.map(|source| match source {
        ComponentSource::Zero => ChannelValue::ZERO,
        ComponentSource::One => ChannelValue::ONE,
        ComponentSource::Channel(i) => {
            let channel = record.channels[usize::from(i)];
            decode_channel(channel, channel.code(raw), minimum)
        }
    }))
}

/// Encodes a value for a channel: clamps it to the channel's range, scales it and rounds once. NaN gives 0 in
/// normalised channels; signed channels encode no value below -1.
pub fn encode_channel(channel: Channel, from: Format, bits: u32, rounding: TargetRounding) -> u32 {
    if let ChannelClass::Float(format) = channel.class {
        return num::ops::convert(&from, format, bits).bits & mask(channel.bits);
    }
    let signed = channel.class != ChannelClass::Unorm;
    let nearest = rounding == TargetRounding::Nearest;
    let (negative, significand, exponent, denominator) = match value::exact(from, bits) {
        Exact::Nan => return 0,
        Exact::Infinite { negative } => (negative, 1, 0, 1),
        Exact::Finite { negative, significand, exponent, denominator } => {
            (negative, significand, exponent, denominator)
        }
    };
    if negative && !signed {
        return 0;
    }
    let scale = steps(channel, negative);
    let magnitude = value::scaled_magnitude(significand, exponent, denominator, scale, nearest) as u32;
    signed_bits(channel, negative, magnitude)
}

/// [`encode_channel`] of `numerator / denominator` into a normalised channel.
pub(crate) fn encode_ratio(channel: Channel, numerator: i128, denominator: u128, rounding: TargetRounding) -> u32 {
    let negative = numerator < 0;
    if negative && channel.class == ChannelClass::Unorm {
        return 0;
    }
    let scale = steps(channel, negative);
    let (product, divisor) = (numerator.unsigned_abs() * u128::from(scale), denominator.max(1));
    let quotient = match rounding {
        TargetRounding::Nearest => (2 * product + divisor) / (2 * divisor),
        TargetRounding::Truncate => product / divisor,
    };
    let magnitude = u32::try_from(quotient.min(u128::from(scale))).unwrap_or(u32::MAX);
    signed_bits(channel, negative, magnitude)
}

/// Number of codes from 0 to 1, or from 0 to -1, of a normalised channel.
fn steps(channel: Channel, negative: bool) -> u64 {
    match (channel.class, negative) {
        (ChannelClass::SplitSnorm, true) => 16,
        (ChannelClass::SplitSnorm, false) => 15,
        _ => u64::from(denominator(channel)),
    }
}

/// Two's complement encoding in a channel.
fn signed_bits(channel: Channel, negative: bool, magnitude: u32) -> u32 {
    if negative { magnitude.wrapping_neg() & mask(channel.bits) } else { magnitude }
}

/// Encodes red, green, blue and alpha, given in format `from`, as a texel (a little-endian integer).
///
/// Components that the format does not store are dropped; luminance is taken from red.
pub fn encode(format: TexelFormat, from: Format, values: [u32; 4], rounding: TargetRounding) -> u128 {
    format.record().stored().iter().fold(0, |raw, &channel| {
        let bits = encode_channel(channel, from, values[usize::from(channel.stored_from)], rounding);
        raw | u128::from(bits) << channel.shift
    })
}
