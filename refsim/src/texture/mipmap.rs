//! Generation of mip levels from the previous level: the box filter of automatic mipmaps.

use super::texel::{denominator, encode_ratio};
use super::{ChannelValue, Image, SignedTexelMinimum, TargetRounding, decode_channel, value};
use crate::device::Rules;
use crate::num::{self, Format};
use crate::texel::{Channel, ChannelClass};
use std::ops::Range;

/// Maximum number of texels averaged into one texel of the next level: two along each of three axes.
const MAX_TAPS: usize = 8;

/// A device's rules for the generation of mip levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MipmapRules {
    /// Rounding of averages.
    pub rounding: TargetRounding,
    /// Value of the smallest signed texel.
    pub signed_texel_minimum: SignedTexelMinimum,
}

impl From<&Rules> for MipmapRules {
    fn from(rules: &Rules) -> Self {
        Self { rounding: rules.mipmap_rounding, signed_texel_minimum: rules.signed_texel_minimum }
    }
}

/// Range of the texels along an axis that are averaged into texel `i` of the next level: 2i and 2i + 1, or i if the
/// axis does not shrink. The last texel of an odd extent is dropped.
pub(crate) fn texels_under(extent: u32, next: u32, i: u32) -> Range<u32> {
    if extent == next { i..i + 1 } else { 2 * i..2 * i + 2 }
}

impl Image {
    /// Fills levels 1 and up, each from the previous level (docs/numbers.md, "Generated mip levels").
    pub fn generate_mipmaps(&mut self, rules: MipmapRules) {
        let size = self.format().bytes();
        for fine in 0..self.levels().len() - 1 {
            let level = self.levels()[fine + 1];
            let mut texels = Vec::with_capacity(level.slices as usize * level.slice_bytes);
            for slice in 0..level.slices {
                for y in 0..level.height {
                    for x in 0..level.width {
                        let mean = self.mean_under(fine, [slice, y, x], rules);
                        texels.extend_from_slice(&mean.to_le_bytes()[..size]);
                    }
                }
            }
            self.bytes_mut()[level.offset..][..texels.len()].copy_from_slice(&texels);
        }
    }

    /// Computes the texel at a slice, row and column of the level after `fine`, as a little-endian integer.
    fn mean_under(&self, fine: usize, [slice, y, x]: [u32; 3], rules: MipmapRules) -> u128 {
        let (finer, level) = (self.levels()[fine], self.levels()[fine + 1]);
        let (mut taps, mut count) = ([0; MAX_TAPS], 0);
        for s in texels_under(finer.slices, level.slices, slice) {
            for row in texels_under(finer.height, level.height, y) {
                for column in texels_under(finer.width, level.width, x) {
                    taps[count] = self.raw(fine as u32, s, row, column);
                    count += 1;
                }
            }
        }
        let taps = &taps[..count];
        let channels = self.format().record().stored().iter();
        channels.fold(0, |raw, &channel| raw | u128::from(mean(channel, taps, rules)) << channel.shift)
    }
}

/// Computes the bits of one channel in the mean of one, two, four or eight texels.
fn mean(channel: Channel, taps: &[u128], rules: MipmapRules) -> u32 {
    if let ChannelClass::Float(format) = channel.class {
        return float_mean(format, channel, taps);
    }
    let sum = taps.iter().fold(0, |sum, &raw| {
        let decoded = decode_channel(channel, channel.code(raw), rules.signed_texel_minimum);
        match decoded {
            ChannelValue::Ratio { numerator, .. } => sum + numerator,
            ChannelValue::Float { .. } => sum,
        }
    });
    encode_ratio(channel, sum.into(), u128::from(denominator(channel)) * taps.len() as u128, rules.rounding)
}

/// Combines pairs along x, then y, then z, in the order of the taps.
fn float_mean(format: Format, channel: Channel, taps: &[u128]) -> u32 {
    let mut values: Vec<u32> =
        taps.iter().map(|&raw| num::ops::convert(&format, Format::FP32, channel.code(raw)).bits).collect();
    while let [_, _, ..] = values[..] {
        let middle = |a, b| value::add(a, value::mul(value::HALF, value::sub(b, a)));
        values = values.chunks_exact(2).map(|pair| middle(pair[0], pair[1])).collect();
    }
    values.first().map_or(0, |&bits| num::ops::convert(&Format::FP32, format, bits).bits)
}
