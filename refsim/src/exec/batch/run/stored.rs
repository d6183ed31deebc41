//! Nearest reads of images that are too large for a table: texels are decoded on each read, for enabled lanes only.

use refsim_lanes::{LANES, LaneRow, Slots};

use super::channel::{channel_in_slot, channel_of, half_to_single, ratios};
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::schedule::FetchStep;
use crate::exec::lower::Arith;
use crate::num::Format;
use crate::texture::{Channel, ChannelValue, Image, SampleRules, SampledSource};

/// The stored texels of level 0.
pub(crate) struct Stored<'a> {
    bytes: &'a [u8],
    texels: usize,
    /// Bytes per texel.
    size: usize,
    components: [Component; 4],
    rules: &'a SampleRules,
}

/// Source of a component.
#[derive(Clone, Copy, PartialEq)]
enum Component {
    Constant(ChannelValue),
    /// Single-precision float at this byte offset.
    Single(usize),
    /// Half-precision float at this byte offset.
    Half(usize),
    /// Fixed-point channel and its denominator; numerator and denominator are below 2^24.
    Ratio(Channel, f64),
    Other(Channel),
}

impl Component {
    fn new(source: SampledSource, rules: &SampleRules) -> Self {
        let value = source.read(rules, |_| 0).value(rules);
        let SampledSource::Stored(channel) = source else { return Self::Constant(value) };
        let byte = usize::from(channel.shift / 8);
        match value {
            ChannelValue::Float { format: Format::FP32, .. } if channel.shift.is_multiple_of(8) => Self::Single(byte),
            ChannelValue::Float { format: Format::FP16, .. } if channel.shift.is_multiple_of(8) => Self::Half(byte),
            ChannelValue::Ratio { denominator, .. } if channel.bits <= 24 => Self::Ratio(channel, denominator.into()),
            _ => Self::Other(channel),
        }
    }

    /// The intermediate value of a stored texel, a single or a numerator; whole rows of these are then rounded.
    #[inline(always)]
    fn kept(self, texel: &[u8], rules: &SampleRules) -> u32 {
        match self {
            Self::Single(at) => texel.get(at..).and_then(|b| b.first_chunk()).map_or(0, |&b| u32::from_le_bytes(b)),
            Self::Half(at) => {
                let bits = texel.get(at..).and_then(|b| b.first_chunk()).map_or(0, |&b| u16::from_le_bytes(b));
                half_to_single(bits.into())
            }
            Self::Ratio(channel, _) => match stored_value(channel, texel, rules) {
                ChannelValue::Ratio { numerator, .. } => (numerator as i32).cast_unsigned(),
                ChannelValue::Float { .. } => 0,
            },
            Self::Constant(_) | Self::Other(_) => 0,
        }
    }
}

/// The exact value of a channel of a stored texel.
#[inline(always)]
fn stored_value(channel: Channel, texel: &[u8], rules: &SampleRules) -> ChannelValue {
    SampledSource::Stored(channel).read(rules, |channel| channel_of(channel, texel)).value(rules)
}

impl<'a> Stored<'a> {
    pub(crate) fn new(image: &'a Image, rules: &'a SampleRules) -> Self {
        let components = rules.sources(image.format()).map(|source| Component::new(source, rules));
        let start = image.offset_of(0, 0, 0, 0).unwrap_or_default();
        let bytes = image.bytes().get(start..).unwrap_or_default();
        let texels = image.width() as usize * image.height() as usize;
        Self { bytes, texels, size: image.format().bytes(), components, rules }
    }

    /// Reads the texels with these indices; the index after the last texel is the border, if any. Disabled lanes are 0.
    pub(crate) fn read(
        &self,
        index: &LaneRow,
        border: &[[u32; 4]],
        step: &FetchStep,
        formats: &LaneFormats,
        (run, slots): (&LaneRow, &mut Slots),
    ) {
        let lane = formats.lane(Arith::Main);
        let mut kept = [[0; LANES]; 4];
        use Component::{Half, Single};
        match self.components {
            [Single(0), Single(4), Single(8), Single(12)] if self.size == 16 => {
                self.gather::<16>((index, run), &mut kept, |texel, c| {
                    u32::from_le_bytes([texel[4 * c], texel[4 * c + 1], texel[4 * c + 2], texel[4 * c + 3]])
                });
            }
            [Half(0), Half(2), Half(4), Half(6)] if self.size == 8 => {
                self.gather::<8>((index, run), &mut kept, |texel, c| {
                    half_to_single(u16::from_le_bytes([texel[2 * c], texel[2 * c + 1]]).into())
                });
            }
            _ => self.gather_any((index, run), &mut kept),
        }
        for (c, to) in step.to.iter().enumerate() {
            let Some(to) = *to else { continue };
            let (kept, out) = (&kept[c], slots.row_mut(to));
            match self.components[c] {
                Component::Constant(value) => out.fill(channel_in_slot(value, self.rules.format, lane)),
                Single(_) | Half(_) => lane.round_singles(formats.simd(), kept, out),
                Component::Ratio(_, denominator) => {
                    let numerators = std::array::from_fn(|i| f64::from(kept[i].cast_signed()));
                    ratios(lane, formats.simd(), &numerators, denominator, out);
                }
                Component::Other(channel) => {
                    out.fill(0);
                    for i in (0..LANES).filter(|&i| run[i] != 0) {
                        let Some(texel) = self.texel(index[i]) else { continue };
                        let value = stored_value(channel, texel, self.rules);
                        out[i] = channel_in_slot(value, self.rules.format, lane);
                    }
                }
            }
            if let [border] = border {
                for (out, _) in out.iter_mut().zip(index).filter(|(_, number)| **number as usize >= self.texels) {
                    *out = border[c];
                }
            }
        }
    }
    fn texel(&self, number: u32) -> Option<&'a [u8]> {
        self.bytes.get(number as usize * self.size..)?.get(..self.size)
    }

    /// Gathers the intermediate values of the enabled lanes' texels.
    fn gather_any(&self, (index, run): (&LaneRow, &LaneRow), kept: &mut [LaneRow; 4]) {
        for i in (0..LANES).filter(|&i| run[i] != 0) {
            let Some(texel) = self.texel(index[i]) else { continue };
            for (component, kept) in self.components.iter().zip(&mut *kept) {
                kept[i] = component.kept(texel, self.rules);
            }
        }
    }

    /// Gathers the intermediate values of texels of `SIZE` bytes, whose components `part` extracts.
    #[inline(always)]
    fn gather<const SIZE: usize>(
        &self,
        (index, run): (&LaneRow, &LaneRow),
        [x, y, z, w]: &mut [LaneRow; 4],
        part: impl Fn(&[u8; SIZE], usize) -> u32,
    ) {
        for i in 0..LANES {
            let texel = self.bytes.get(index[i] as usize * SIZE..).and_then(<[u8]>::first_chunk);
            let Some(texel) = texel.filter(|_| run[i] != 0) else { continue };
            (x[i], y[i], z[i], w[i]) = (part(texel, 0), part(texel, 1), part(texel, 2), part(texel, 3));
        }
    }
}
