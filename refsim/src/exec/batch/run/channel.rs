//! Conversion of texel channels to lane values.

use refsim_lanes::{AnyLane, LANES, LaneRow, SimdLevel, div_odd_long};

use crate::num::Format;
use crate::texture::{Channel, ChannelValue};

/// Divides doubles by an integer below 2^24 and rounds to the format.
pub(crate) fn ratios(lane: &AnyLane, simd: SimdLevel, values: &[f64; LANES], divisor: f64, out: &mut LaneRow) {
    if divisor == 1.0 {
        return lane.round_row(simd, values, out);
    }
    let mut quotients = [0.0; LANES];
    simd.run(
        #[inline(always)]
        || {
            for i in 0..LANES {
                quotients[i] = div_odd_long(values[i], divisor);
            }
        },
    );
    lane.round_row(simd, &quotients, out);
}

/// Returns `true` if decoding every code of a channel is less work than decoding this number of texels.
pub(super) const fn pays_by_code(channel: Channel, texels: usize) -> bool {
    channel.bits <= 8 && texels > 1024
}

/// Extracts the bits of a channel.
pub(crate) fn channel_of(channel: Channel, texel: &[u8]) -> u32 {
    let first = usize::from(channel.shift / 8);
    match (channel.shift % 8, channel.bits, texel.get(first..)) {
        (0, 8, Some(&[a, ..])) => a.into(),
        (0, 16, Some(&[a, b, ..])) => u16::from_le_bytes([a, b]).into(),
        (0, 32, Some(&[a, b, c, d, ..])) => u32::from_le_bytes([a, b, c, d]),
        _ => {
            let raw = texel.iter().rev().fold(0u128, |raw, &byte| raw << 8 | u128::from(byte));
            (raw >> channel.shift) as u32
        }
    }
}

/// Converts a channel's value to the register format, as a raw value.
pub(crate) fn channel_in_slot(channel: ChannelValue, format: Format, lane: &AnyLane) -> u32 {
    match channel {
        // Both below 2^24: one division, rounded to odd.
        ChannelValue::Ratio { numerator, denominator }
            if numerator.unsigned_abs() < 1 << 24 && denominator < 1 << 24 =>
        {
            lane.round(div_odd_long(numerator as f64, f64::from(denominator)))
        }
        _ => lane.decode(channel.to_format(format)),
    }
}
