//! Encoding of colour targets for the kernel.

use super::texture::texel_words;
use crate::num::Format;
use crate::output::WriteMask;
use crate::texture::{Channel, ChannelClass, TexelFormat};

/// Words per target in `draw`.
pub const WORDS: usize = 64;

/// A colour target in `video`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TargetPlace {
    /// The texel format.
    pub format: TexelFormat,
    /// Offset of the first word.
    pub base: u32,
    /// Row stride in texels.
    pub width: u32,
}

/// Encodes a target with a write mask; the first word is 0 if nothing is written.
pub fn words(place: &TargetPlace, mask: WriteMask) -> [u32; WORDS] {
    let record = place.format.record();
    let stored = record.stored();
    let mut out = [0; WORDS];
    let written = stored.iter().filter(|c| mask.has(c.stored_from)).fold(0u128, |bits, c| bits | ones(c) << c.shift);
    let alpha = stored.iter().position(|c| c.stored_from == 3);
    let head = [
        u32::from(written != 0),
        place.base,
        place.width,
        texel_words(place.format) as u32,
        stored.len() as u32,
        u32::from(record.is_float()),
    ];
    out[..6].copy_from_slice(&head);
    for (i, word) in out[6..10].iter_mut().enumerate() {
        *word = (written >> (32 * i)) as u32;
    }
    out[11] = alpha.map_or(4, |i| i as u32);
    // An alpha that is not stored is blended as an unsigned channel with the width of the widest channel.
    let widest = stored.iter().map(|c| c.bits).max().unwrap_or(8);
    let spare = Channel { shift: 0, bits: widest, class: ChannelClass::Unorm, stored_from: 3 };
    let channels = stored.iter().chain((stored.len()..4).map(|_| &spare)).chain([&spare]);
    for (slot, channel) in out[16..].chunks_exact_mut(8).zip(channels) {
        slot[..6].copy_from_slice(&channel_words(channel));
    }
    out
}

fn ones(channel: &Channel) -> u128 {
    u128::from(u32::MAX >> (32 - channel.bits))
}

fn channel_words(channel: &Channel) -> [u32; 6] {
    let (class, float) = match channel.class {
        ChannelClass::Unorm => (0, 0),
        ChannelClass::Snorm => (1, 0),
        ChannelClass::SplitSnorm => (2, 0),
        // The second number is the index in the table of formats.
        ChannelClass::Float(Format::FP16) => (3, 5),
        ChannelClass::Float(Format::FP24) => (3, 6),
        ChannelClass::Float(_) => (3, 7),
    };
    let denominator = crate::texture::denominator(*channel);
    [channel.shift.into(), channel.bits.into(), class, channel.stored_from.into(), float, denominator]
}
