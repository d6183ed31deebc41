//! The sampling rules of a device, and the components that a sampler reads from texels and borders: bytes or exact
//! values, according to the rules.

use super::{
    BorderStorage, ChannelValue, FilterArithmetic, MissingChannels, SignedTexelMinimum, TargetRounding, TexelFormat,
    TexelValues, WeightRounding, decode_channel, encode,
};
use crate::device::Rules;
use crate::num::Format;
use crate::texel::{Channel, ChannelClass, ComponentSource};

/// A device's sampling rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleRules {
    /// Format of the result.
    pub format: Format,
    /// Fraction bits of filter weights, at most 12.
    pub filter_fraction_bits: u8,
    /// Fraction bits of the level of detail, at most 8.
    pub lod_fraction_bits: u8,
    /// Value of the smallest signed texel.
    pub signed_texel_minimum: SignedTexelMinimum,
    /// Rounding of filter weights.
    pub filter_weight_rounding: WeightRounding,
    /// Arithmetic of filters on bytes.
    pub filter_arithmetic: FilterArithmetic,
    /// Values of narrow channels.
    pub texel_values: TexelValues,
    /// Components that a texel does not store.
    pub missing_channels: MissingChannels,
    /// Storage of the border colour.
    pub border_storage: BorderStorage,
}

impl SampleRules {
    /// Rules with Direct3D's values and exact filters with 8 fraction bits, for registers of a format.
    pub const fn exact(format: Format) -> Self {
        Self {
            format,
            filter_fraction_bits: 8,
            lod_fraction_bits: 8,
            signed_texel_minimum: SignedTexelMinimum::Clamp,
            filter_weight_rounding: WeightRounding::Nearest,
            filter_arithmetic: FilterArithmetic::Exact,
            texel_values: TexelValues::Fractions,
            missing_channels: MissingChannels::Direct3d,
            border_storage: BorderStorage::Texel,
        }
    }
}

impl From<&Rules> for SampleRules {
    fn from(rules: &Rules) -> Self {
        Self {
            format: rules.format,
            filter_fraction_bits: rules.filter_fraction_bits,
            lod_fraction_bits: rules.lod_fraction_bits,
            signed_texel_minimum: rules.signed_texel_minimum,
            filter_weight_rounding: rules.filter_weight_rounding,
            filter_arithmetic: rules.filter_arithmetic,
            texel_values: rules.texel_values,
            missing_channels: rules.missing_channels,
            border_storage: rules.border_storage,
        }
    }
}

/// Source of a component that a sampler returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SampledSource {
    /// A stored channel.
    Stored(Channel),
    /// Not stored: a constant byte, 0 or 255.
    Missing(u8),
}

impl SampledSource {
    /// Reads the component; `bits` extracts the bits of a channel.
    pub(crate) fn read(self, rules: &SampleRules, bits: impl Fn(Channel) -> u32) -> SampledComponent {
        match self {
            Self::Stored(channel) => rules.component(channel, bits(channel)),
            Self::Missing(byte) => SampledComponent::Byte { byte: byte.into(), signed: false },
        }
    }
}

/// A component before the filter. All components of one source are bytes, or have the same denominator or format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SampledComponent {
    /// A byte.
    Byte {
        /// -128 to 127 if signed, else 0 to 255.
        byte: i32,
        signed: bool,
    },
    /// A channel that is not a byte.
    Value(ChannelValue),
}

impl SampledComponent {
    /// The exact value for a register. The smallest code of a signed byte is clamped here, so a filter on bytes sees it
    /// unclamped.
    pub(crate) fn value(self, rules: &SampleRules) -> ChannelValue {
        let (byte, signed) = match self {
            Self::Value(value) => return value,
            Self::Byte { byte, signed } => (i64::from(byte), signed),
        };
        let (scale, denominator) = match (signed, rules.texel_values) {
            (false, _) => (1, 255),
            (true, TexelValues::Fractions) => (1, 127),
            (true, TexelValues::Bytes) => (2, 255),
        };
        let least = match rules.signed_texel_minimum {
            SignedTexelMinimum::Clamp => -i64::from(denominator),
            SignedTexelMinimum::BelowMinusOne => i64::MIN,
        };
        ChannelValue::Ratio { numerator: (scale * byte).max(least), denominator }
    }
}

impl SampleRules {
    /// Sources of red, green, blue and alpha.
    pub(crate) fn sources(&self, format: TexelFormat) -> [SampledSource; 4] {
        let components = match self.missing_channels {
            MissingChannels::Direct3d => format.record().components,
            MissingChannels::Xbox => format.xbox_components(),
        };
        components.map(|source| match source {
            ComponentSource::Channel(i) => SampledSource::Stored(format.record().channels[usize::from(i)]),
            ComponentSource::Zero => SampledSource::Missing(0),
            ComponentSource::One => SampledSource::Missing(255),
        })
    }

    /// Red, green, blue and alpha of a texel, given as a little-endian integer.
    pub(crate) fn texel(&self, format: TexelFormat, raw: u128) -> [SampledComponent; 4] {
        self.sources(format).map(|source| source.read(self, |channel| channel.code(raw)))
    }

    /// Red, green, blue and alpha outside an image, for a border color in FP32 bits.
    pub(crate) fn border(&self, format: TexelFormat, color: [u32; 4]) -> [SampledComponent; 4] {
        let stored = |format| encode(format, Format::FP32, color, TargetRounding::Nearest);
        let texel = self.texel(format, stored(format));
        if self.border_storage == BorderStorage::Texel || format.record().is_signed() {
            return texel;
        }
        let bytes = self.texel(TexelFormat::Rgba8, stored(TexelFormat::Rgba8));
        std::array::from_fn(|i| if matches!(texel[i], SampledComponent::Byte { .. }) { bytes[i] } else { texel[i] })
    }

    fn component(&self, channel: Channel, bits: u32) -> SampledComponent {
        let byte = match (channel.bits, self.texel_values) {
            _ if matches!(channel.class, ChannelClass::Float(_)) => None,
            (8, _) => Some(bits as u8),
            (width @ 1..8, TexelValues::Bytes) => Some(repeated(bits, width)),
            (16, TexelValues::Bytes) => Some((bits >> 8) as u8),
            _ => None,
        };
        let Some(byte) = byte else {
            return SampledComponent::Value(decode_channel(channel, bits, self.signed_texel_minimum));
        };
        match channel.class {
            ChannelClass::Unorm => SampledComponent::Byte { byte: byte.into(), signed: false },
            _ => SampledComponent::Byte { byte: byte.cast_signed().into(), signed: true },
        }
    }
}

/// Repeats the lowest `width` bits, 1 to 8, until they fill a byte from the top down.
fn repeated(bits: u32, width: u8) -> u8 {
    let top = (bits << (8 - width)) as u8;
    (0..8).step_by(usize::from(width)).fold(0, |byte, filled| byte | top >> filled)
}
