//! Nearest texels of images that are too large for a table: decoded as they are read, those of the lanes that run.

use super::channel::{channel_in_slot, channel_of, ratios};
use super::slots::Slots;
use crate::exec::batch::lanes::{LANES, LaneFormats, LaneRow, with_any_lane};
use crate::exec::batch::schedule::FetchStep;
use crate::exec::lower::Arith;
use crate::num::Format;
use crate::texture::{Channel, ChannelValue, ComponentSource, Image, SampleRules, decode_channel};

/// The stored texels of level 0.
pub(crate) struct Stored<'a> {
    bytes: &'a [u8],
    texels: usize,
    /// Bytes of a texel.
    size: usize,
    components: [Component; 4],
    rules: &'a SampleRules,
}

/// Where a component comes from.
#[derive(Clone, Copy)]
enum Component {
    Constant(ChannelValue),
    /// A single float at this byte of the texel.
    Single(usize),
    Other(Channel),
}

impl<'a> Stored<'a> {
    pub(crate) fn new(image: &'a Image, rules: &'a SampleRules) -> Self {
        let record = image.format().record();
        let components = record.components.map(|source| match source {
            ComponentSource::Zero => Component::Constant(ChannelValue::ZERO),
            ComponentSource::One => Component::Constant(ChannelValue::ONE),
            ComponentSource::Channel(i) => {
                let channel = record.channels[usize::from(i)];
                match decode_channel(channel, 0, rules.signed_texel_minimum) {
                    ChannelValue::Float { format: Format::FP32, .. } if channel.shift.is_multiple_of(8) => {
                        Component::Single(usize::from(channel.shift / 8))
                    }
                    _ => Component::Other(channel),
                }
            }
        });
        let start = image.offset_of(0, 0, 0, 0).unwrap_or_default();
        let bytes = image.bytes().get(start..).unwrap_or_default();
        let texels = image.width() as usize * image.height() as usize;
        Self { bytes, texels, size: image.format().bytes(), components, rules }
    }

    /// Reads the texels of these numbers; beyond the last lies the border, if there is one. Lanes that do not run are
    /// 0.
    pub(crate) fn read(
        &self,
        index: &LaneRow,
        border: &[[u32; 4]],
        step: &FetchStep,
        formats: &LaneFormats,
        (run, slots): (&LaneRow, &mut Slots),
    ) {
        let lane = formats.lane(Arith::Main);
        let mut singles = [[0.0_f64; LANES]; 4];
        for (i, (&number, _)) in index.iter().zip(run).enumerate().filter(|(_, (_, run))| **run != 0) {
            let at = number as usize * self.size;
            let Some(texel) = self.bytes.get(at..at + self.size) else { continue };
            for (component, singles) in self.components.iter().zip(&mut singles) {
                if let Component::Single(at) = *component
                    && let Some(&[a, b, c, d]) = texel.get(at..).and_then(|bytes| bytes.first_chunk())
                {
                    singles[i] = f64::from(f32::from_le_bytes([a, b, c, d]));
                }
            }
        }
        for (c, to) in step.to.iter().enumerate() {
            let Some(to) = *to else { continue };
            let out = slots.row_mut(to);
            match self.components[c] {
                Component::Constant(value) => out.fill(channel_in_slot(value, self.rules.format, lane)),
                Component::Single(_) => with_any_lane!(lane, |lane| {
                    formats.simd().run(
                        #[inline(always)]
                        || ratios(lane, &singles[c], 1.0, out),
                    )
                }),
                Component::Other(channel) => {
                    out.fill(0);
                    for (out, (&number, _)) in
                        out.iter_mut().zip(index.iter().zip(run)).filter(|(_, (_, run))| **run != 0)
                    {
                        let at = number as usize * self.size;
                        let Some(texel) = self.bytes.get(at..at + self.size) else { continue };
                        let value =
                            decode_channel(channel, channel_of(channel, texel), self.rules.signed_texel_minimum);
                        *out = channel_in_slot(value, self.rules.format, lane);
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
}
