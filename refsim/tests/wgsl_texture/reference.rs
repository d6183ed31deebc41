//! Expected results of reads, computed by `refsim::texture` as in the scalar executor.

use super::cases::{Case, Read};
use refsim::num::{Format, ops};
use refsim::texture::{
    Image, Lod, SampleRules, SamplerState, TexelFormat, TextureKind, lod_from_derivatives, sample, unbound,
};

/// Components of one lane, as raw values of the shader.
pub(crate) fn texel(case: &Case, read: &Read, lane: usize) -> [u32; 4] {
    let format = case.rules.format;
    let Some(binding) = case.binding() else { return unbound(format).map(|x| raw(format, x)) };
    let own = read.coordinates[lane];
    let lod = if binding.needs_detail() {
        let across = |bit: usize| {
            let (low, high) = (read.coordinates[lane & !bit], read.coordinates[lane | bit]);
            [0, 1, 2, 3].map(|i: usize| ops::sub(Format::FP32, high[i], low[i]).bits)
        };
        let [ddx, ddy] = if read.detail == 2 { read.gradients[lane] } else { [across(1), across(2)] };
        let level = lod_from_derivatives(binding.image, own, ddx, ddy, case.rules.lod_fraction_bits);
        let biased = || ops::add(Format::FP32, level, read.bias[lane]).bits;
        Lod::Level(if read.detail == 1 { biased() } else { level })
    } else {
        Lod::Base
    };
    sample(Some(binding.image), &binding.state, &case.rules, own, lod).map(|x| raw(format, x))
}

/// Components of a stored texel, given as a little-endian integer.
pub(crate) fn stored(format: TexelFormat, raw: u128, rules: &SampleRules) -> [u32; 4] {
    let bytes = raw.to_le_bytes()[..format.bytes()].to_vec();
    let image = Image::from_bytes(format, TextureKind::D2, [1, 1, 1], 1, bytes).expect("one texel");
    sample(Some(&image), &SamplerState::NEAREST_CLAMP, rules, [0; 4], Lod::Base)
}

/// Converts a bit pattern to the shader's raw value.
pub(crate) fn raw(format: Format, bits: u32) -> u32 {
    if format.is_fixed() {
        let spare = 32 - format.width();
        return ((bits << spare).cast_signed() >> spare).cast_unsigned();
    }
    ops::convert(&format, Format::FP32, bits).bits
}
