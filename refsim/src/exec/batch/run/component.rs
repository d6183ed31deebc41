//! Sources of the components of a filtered read, and the components' values before filtering.

use refsim_lanes::AnyLane;

use super::channel::{channel_in_slot, channel_of};
use crate::num::Format;
use crate::texture::{
    AddressMode, Channel, ChannelValue, FilterArithmetic, SampleRules, SampledComponent, SampledSource, SamplerState,
};

/// Source of a result component.
#[derive(Clone, Copy, Debug)]
pub(super) enum FilteredComponent {
    /// A raw value that is the same for texels and the border.
    Constant(u32),
    /// A sum of numerators, and its denominator. Exact: weights along three axes have 36 bits, the fixed-point channels of
    /// all formats 16 at most, and a double 53.
    Ratio(SampledSource, f64),
    /// An interpolated byte; the flag is `true` if the byte is signed.
    Byte(SampledSource, bool),
    Single(SampledSource),
}

impl FilteredComponent {
    pub(super) fn new(
        (source, border): (SampledSource, SampledComponent),
        state: &SamplerState,
        rules: &SampleRules,
        lane: &AnyLane,
    ) -> Self {
        let component = source.read(rules, |_| 0);
        let value = component.value(rules);
        let bordered = [state.address_u, state.address_v, state.address_w].contains(&AddressMode::Border);
        match (source, component, value) {
            (SampledSource::Missing(_), ..) if !bordered || component == border => {
                Self::Constant(channel_in_slot(value, rules.format, lane))
            }
            (_, SampledComponent::Byte { signed, .. }, _) if rules.filter_arithmetic == FilterArithmetic::ByteLerps => {
                Self::Byte(source, signed)
            }
            (.., ChannelValue::Ratio { denominator, .. }) => Self::Ratio(source, denominator.into()),
            (.., ChannelValue::Float { .. }) => Self::Single(source),
        }
    }

    /// The fixed-point channel that is read, if any.
    pub(super) const fn fixed_point_channel(self) -> Option<Channel> {
        match self {
            Self::Ratio(SampledSource::Stored(channel), _) | Self::Byte(SampledSource::Stored(channel), _) => {
                Some(channel)
            }
            _ => None,
        }
    }

    /// The numerator or byte for each code of a channel.
    pub(super) fn codes(self, channel: Channel, rules: &SampleRules) -> Vec<u32> {
        (0..1 << channel.bits).map(|bits| self.decoded(|_| bits, rules)).collect()
    }

    /// Decodes a stored texel to its numerator, byte or single-precision value.
    pub(super) fn decode(self, texel: &[u8], rules: &SampleRules) -> u32 {
        self.decoded(|channel| channel_of(channel, texel), rules)
    }

    fn decoded(self, bits: impl Fn(Channel) -> u32, rules: &SampleRules) -> u32 {
        match self {
            Self::Constant(_) => 0,
            Self::Ratio(source, _) | Self::Byte(source, _) | Self::Single(source) => {
                self.kept(source.read(rules, bits), rules)
            }
        }
    }

    /// The number that [`Self::kept`] encodes.
    pub(super) fn number(self, kept: u32) -> f64 {
        match self {
            Self::Single(_) => f64::from(f32::from_bits(kept)),
            _ => f64::from(kept.cast_signed()),
        }
    }

    /// Encodes a component as the filter's input: a numerator, a byte or a single.
    pub(super) fn kept(self, component: SampledComponent, rules: &SampleRules) -> u32 {
        match (self, component, component.value(rules)) {
            (Self::Byte(..), SampledComponent::Byte { byte, .. }, _) => byte.cast_unsigned(),
            (_, _, ChannelValue::Ratio { numerator, .. }) => (numerator as i32).cast_unsigned(),
            (.., float) => float.to_format(Format::FP32),
        }
    }
}
