//! Blending.
//!
//! guess: a fixed-point blender works on values of the target's precision. The source is first clamped and rounded into
//! the target's channels; then `source * factor op destination * factor` is exact, and rounded once into the channel.
//! For floating-point targets the products and the sum are one FP32 operation each, and the result is converted once.

use serde::Deserialize;
use strum::VariantArray;

use crate::num::{self, Format};
use crate::texture::{
    Channel, ChannelClass, ChannelValue, SignedTexelMinimum, TargetRounding, TexelFormat, decode, decode_channel,
    encode_channel, encode_ratio, value,
};

/// Blend factor of a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, VariantArray)]
#[serde(rename_all = "kebab-case")]
pub enum BlendFactor {
    /// 0
    Zero,
    /// 1
    One,
    /// The source component.
    #[serde(rename = "source-color")]
    SrcColor,
    /// 1 - the source component
    #[serde(rename = "inverse-source-color")]
    InvSrcColor,
    /// Source alpha.
    #[serde(rename = "source-alpha")]
    SrcAlpha,
    /// 1 - source alpha
    #[serde(rename = "inverse-source-alpha")]
    InvSrcAlpha,
    /// Destination alpha; 1 if the target does not store alpha.
    #[serde(rename = "destination-alpha")]
    DestAlpha,
    /// 1 - destination alpha
    #[serde(rename = "inverse-destination-alpha")]
    InvDestAlpha,
    /// The destination component.
    #[serde(rename = "destination-color")]
    DestColor,
    /// 1 - the destination component
    #[serde(rename = "inverse-destination-color")]
    InvDestColor,
    /// `min(source alpha, 1 - destination alpha)` for colours, 1 for alpha.
    #[serde(rename = "source-alpha-saturate")]
    SrcAlphaSat,
}

impl BlendFactor {
    /// Every factor.
    pub const ALL: &'static [Self] = Self::VARIANTS;
}

/// Blend operation: combination of the two products.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BlendOp {
    /// source + destination
    #[default]
    Add,
    /// source - destination
    Subtract,
    /// destination - source
    ReverseSubtract,
    /// The smaller of source and destination; factors are not used.
    Min,
    /// The larger of source and destination; factors are not used.
    Max,
}

/// One blend equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BlendEquation {
    /// Factor of the fragment's colour.
    pub source: BlendFactor,
    /// Factor of the target's contents.
    pub destination: BlendFactor,
    /// Combination of the two products.
    pub op: BlendOp,
}

/// The state of the blender.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BlendState {
    /// Equation of red, green and blue.
    pub color: BlendEquation,
    /// Equation of alpha.
    pub alpha: BlendEquation,
}

impl BlendState {
    /// Blend state with the same equation for colour and alpha.
    pub const fn both(source: BlendFactor, destination: BlendFactor, op: BlendOp) -> Self {
        let equation = BlendEquation { source, destination, op };
        Self { color: equation, alpha: equation }
    }
}

/// Blends a colour, in number format `from`, with the texel `destination`; returns the resulting texel.
pub fn blend_texel(
    format: TexelFormat,
    destination: u128,
    from: Format,
    source: [u32; 4],
    state: &BlendState,
    rounding: TargetRounding,
) -> u128 {
    let record = format.record();
    let stored = decode(format, destination, SignedTexelMinimum::Clamp);
    let equation = |component: u8| if component == 3 { &state.alpha } else { &state.color };
    if record.is_float() {
        let s = source.map(|bits| num::ops::convert(&from, Format::FP32, bits).bits);
        let d = stored.to_format(Format::FP32);
        return record.stored().iter().fold(0, |raw, channel| {
            let result = blend(equation(channel.stored_from), s, d, usize::from(channel.stored_from));
            raw | u128::from(encode_channel(*channel, Format::FP32, result, rounding)) << channel.shift
        });
    }
    let s = quantised_source(format, from, source, rounding);
    let d = stored.0.map(Ratio::of);
    record.stored().iter().fold(0, |raw, channel| {
        let result = blend(equation(channel.stored_from), s, d, usize::from(channel.stored_from));
        raw | u128::from(encode_ratio(*channel, result.numerator, result.denominator.unsigned_abs(), rounding))
            << channel.shift
    })
}

/// Rounds the source to the target's channels; a component that the target does not store is rounded as an unsigned
/// channel with the width of the widest channel.
fn quantised_source(format: TexelFormat, from: Format, source: [u32; 4], rounding: TargetRounding) -> [Ratio; 4] {
    let record = format.record();
    let bits = record.stored().iter().map(|c| c.bits).max().unwrap_or(8);
    [0, 1, 2, 3].map(|i: u8| {
        let unstored = Channel { shift: 0, bits, class: ChannelClass::Unorm, stored_from: i };
        let channel = record.stored().iter().copied().find(|c| c.stored_from == i).unwrap_or(unstored);
        let code = encode_channel(channel, from, source[usize::from(i)], rounding);
        Ratio::of(decode_channel(channel, code, SignedTexelMinimum::Clamp))
    })
}

/// Arithmetic of a blender: FP32 for float targets, exact fractions for fixed-point targets.
trait BlendValue: Copy {
    const ZERO: Self;
    const ONE: Self;
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn is_below(self, other: Self) -> bool;
}

fn blend<T: BlendValue>(equation: &BlendEquation, source: [T; 4], destination: [T; 4], component: usize) -> T {
    let (s, d) = (source[component], destination[component]);
    match equation.op {
        BlendOp::Min => return if d.is_below(s) { d } else { s },
        BlendOp::Max => return if s.is_below(d) { d } else { s },
        _ => {}
    }
    // A factor of 0 removes its term and a factor of 1 keeps it unchanged, so infinities don't give NaN, and -0 is
    // kept.
    let term = |value: T, factor: BlendFactor| match factor {
        BlendFactor::Zero => None,
        BlendFactor::One => Some(value),
        BlendFactor::SrcAlphaSat if component == 3 => Some(value),
        _ => Some(value.mul(factor_value(factor, source, destination, component))),
    };
    let (s, d) = (term(s, equation.source), term(d, equation.destination));
    match (equation.op, s, d) {
        (BlendOp::Subtract, Some(s), Some(d)) => s.sub(d),
        (BlendOp::Subtract, None, Some(d)) => T::ZERO.sub(d),
        (BlendOp::ReverseSubtract, Some(s), Some(d)) => d.sub(s),
        (BlendOp::ReverseSubtract, Some(s), None) => T::ZERO.sub(s),
        (_, Some(s), Some(d)) => s.add(d),
        (_, Some(one), None) | (_, None, Some(one)) => one,
        (_, None, None) => T::ZERO,
    }
}

fn factor_value<T: BlendValue>(factor: BlendFactor, source: [T; 4], destination: [T; 4], component: usize) -> T {
    let rest = |value: T| T::ONE.sub(value);
    match factor {
        BlendFactor::Zero => T::ZERO,
        BlendFactor::One => T::ONE,
        BlendFactor::SrcColor => source[component],
        BlendFactor::InvSrcColor => rest(source[component]),
        BlendFactor::SrcAlpha => source[3],
        BlendFactor::InvSrcAlpha => rest(source[3]),
        BlendFactor::DestAlpha => destination[3],
        BlendFactor::InvDestAlpha => rest(destination[3]),
        BlendFactor::DestColor => destination[component],
        BlendFactor::InvDestColor => rest(destination[component]),
        BlendFactor::SrcAlphaSat => {
            let free = rest(destination[3]);
            if free.is_below(source[3]) { free } else { source[3] }
        }
    }
}

/// FP32 blending; values are bit patterns.
impl BlendValue for u32 {
    const ZERO: Self = value::ZERO;
    const ONE: Self = value::ONE;

    fn add(self, other: Self) -> Self {
        value::add(self, other)
    }

    fn sub(self, other: Self) -> Self {
        value::sub(self, other)
    }

    fn mul(self, other: Self) -> Self {
        value::mul(self, other)
    }

    fn is_below(self, other: Self) -> bool {
        !value::is_nan(self) && !value::is_nan(other) && value::order_key(self) < value::order_key(other)
    }
}

/// An exact fraction. Its parts stay small: at most four 16-bit channel denominators are multiplied.
#[derive(Clone, Copy, Debug)]
struct Ratio {
    numerator: i128,
    denominator: i128,
}

impl Ratio {
    fn of(value: ChannelValue) -> Self {
        match value {
            ChannelValue::Ratio { numerator, denominator } => {
                Self { numerator: i128::from(numerator), denominator: i128::from(denominator) }
            }
            // Unreachable: fixed-point targets have no float channels.
            ChannelValue::Float { .. } => Self::ZERO,
        }
    }
}

impl BlendValue for Ratio {
    const ZERO: Self = Self { numerator: 0, denominator: 1 };
    const ONE: Self = Self { numerator: 1, denominator: 1 };

    fn add(self, other: Self) -> Self {
        if self.denominator == other.denominator {
            return Self { numerator: self.numerator + other.numerator, denominator: self.denominator };
        }
        Self {
            numerator: self.numerator * other.denominator + other.numerator * self.denominator,
            denominator: self.denominator * other.denominator,
        }
    }

    fn sub(self, other: Self) -> Self {
        self.add(Self { numerator: -other.numerator, denominator: other.denominator })
    }

    fn mul(self, other: Self) -> Self {
        Self { numerator: self.numerator * other.numerator, denominator: self.denominator * other.denominator }
    }

    fn is_below(self, other: Self) -> bool {
        self.numerator * other.denominator < other.numerator * self.denominator
    }
}
