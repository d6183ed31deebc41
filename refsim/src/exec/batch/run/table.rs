//! Nearest reads in rows from decoded 1-D, 2-D and rectangle textures.

use refsim_lanes::{AnyLane, LANES, LaneRow, SimdLevel};

use super::address::{TexelAxis, nearest};
use super::channel::{channel_in_slot, channel_of, pays_by_code, ratios};
use crate::exec::SamplerBinding;
use crate::num::Format;
use crate::texture::{
    AddressMode, Channel, ChannelValue, Image, SampleRules, SampledSource, SamplerState, TextureKind, fetch_nearest,
};

/// Maximum number of texels of an image with a table: 4 MiB. Texels of larger images are decoded on each read.
pub(crate) const MAX_TABLE_TEXELS: usize = 1 << 18;

/// A decoded 1-D, 2-D or rectangle texture.
#[derive(Debug)]
pub(crate) struct TexelTable {
    /// All texels in the register format as raw values, the border texel last; for a large image only the border texel.
    pub(crate) texels: Vec<[u32; 4]>,
    pub(crate) large: bool,
    axes: [TexelAxis; 2],
}

impl TexelTable {
    /// Returns `true` if a table applies to the binding.
    pub(crate) fn fits(binding: &SamplerBinding<'_>) -> bool {
        let image = binding.image;
        let plane = matches!(image.kind(), TextureKind::D1 | TextureKind::D2 | TextureKind::Rectangle);
        binding.is_plain() && plane
    }

    pub(crate) fn new(binding: &SamplerBinding<'_>, rules: &SampleRules, lane: &AnyLane) -> Self {
        let image = binding.image;
        let kind = image.kind();
        let (width, height) = (image.width(), image.height());
        let large = is_large(image);
        let mut texels = if large { Vec::new() } else { all_texels(image, rules, lane) };
        let state = &binding.state;
        let modes = match kind {
            TextureKind::Rectangle => [state.address_u, state.address_v]
                .map(|m| if m == AddressMode::Border { m } else { AddressMode::Clamp }),
            _ => [state.address_u, state.address_v],
        };
        if modes.contains(&AddressMode::Border) {
            // NaN would address as 0, so the coordinates that read the border colour are finite and far outside.
            let outside = [0x4b80_0000, 0x4b80_0000, 0, 0];
            let bordered = SamplerState {
                address_u: AddressMode::Border,
                address_v: if kind == TextureKind::D1 { state.address_v } else { AddressMode::Border },
                ..*state
            };
            texels.push(fetch_nearest(image, &bordered, rules, outside).map(|bits| lane.decode(bits)));
        }
        let scale = match kind {
            TextureKind::Rectangle => [1.0, 1.0],
            TextureKind::D1 => [f64::from(width), 0.0],
            _ => [f64::from(width), f64::from(height)],
        };
        let axis = |i: usize, size| TexelAxis { size, scale: scale[i], mode: modes[i] };
        Self { texels, large, axes: [axis(0, width), axis(1, height)] }
    }

    /// Index of each lane's texel.
    #[inline(always)]
    pub(crate) fn indices(&self, u: &LaneRow, v: &LaneRow, out: &mut LaneRow) {
        let (mut x, mut y) = ([0i32; LANES], [0i32; LANES]);
        let [across, down] = self.axes;
        nearest(u, across, &mut x);
        nearest(v, down, &mut y);
        let (width, border) = (across.size.cast_signed(), (across.size * down.size).cast_signed());
        for i in 0..LANES {
            let inside = (x[i] >= 0) & (y[i] >= 0);
            out[i] = (if inside { y[i] * width + x[i] } else { border }).cast_unsigned();
        }
    }
}

/// Returns `true` if an image is too large for a table.
pub(crate) fn is_large(image: &Image) -> bool {
    image.width() as usize * image.height() as usize > MAX_TABLE_TEXELS
}

/// Decodes all texels of level 0 to raw values in the register format, row by row.
fn all_texels(image: &Image, rules: &SampleRules, lane: &AnyLane) -> Vec<[u32; 4]> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let mut texels = Vec::with_capacity(width * height + 1);
    texels.resize(width * height, [0; 4]);
    for (c, source) in rules.sources(image.format()).into_iter().enumerate() {
        let value = |bits| source.read(rules, |_| bits).value(rules);
        let SampledSource::Stored(channel) = source else {
            let raw = channel_in_slot(value(0), rules.format, lane);
            texels.iter_mut().for_each(|texel| texel[c] = raw);
            continue;
        };
        // Rows are contiguous.
        let size = image.format().bytes();
        let start = image.offset_of(0, 0, 0, 0).unwrap_or_default();
        let bytes = image.bytes().get(start..).unwrap_or_default();
        if pays_by_code(channel, texels.len()) {
            let raw = |bits| channel_in_slot(value(bits), rules.format, lane);
            let values: Vec<u32> = (0..1 << channel.bits).map(raw).collect();
            for (texel, bytes) in texels.iter_mut().zip(bytes.chunks_exact(size)) {
                let bits = channel_of(channel, bytes) as usize & (values.len() - 1);
                texel[c] = values[bits];
            }
            continue;
        }
        for (texels, bytes) in texels.chunks_mut(LANES).zip(bytes.chunks(LANES * size)) {
            decode_block((channel, &value), bytes.chunks_exact(size), rules.format, lane, |i, raw| {
                if let Some(texel) = texels.get_mut(i) {
                    texel[c] = raw;
                }
            });
        }
    }
    texels
}

/// Decodes one channel of up to 256 texels: in rows for fixed point of up to 24 bits and for single precision, else one
/// by one.
fn decode_block<'t>(
    (channel, value): (Channel, &impl Fn(u32) -> ChannelValue),
    texels: impl Iterator<Item = &'t [u8]>,
    format: Format,
    lane: &AnyLane,
    mut put: impl FnMut(usize, u32),
) {
    let mut values = [0.0; LANES];
    let mut raw = [0; LANES];
    let mut divisor = 1.0;
    let narrow = channel.bits <= 24;
    for (i, texel) in texels.take(LANES).enumerate() {
        match value(channel_of(channel, texel)) {
            ChannelValue::Ratio { numerator, denominator } if narrow => {
                values[i] = numerator as f64;
                divisor = f64::from(denominator);
            }
            ChannelValue::Float { format: Format::FP32, bits } => values[i] = f64::from(f32::from_bits(bits)),
            other => {
                put(i, channel_in_slot(other, format, lane));
                continue;
            }
        }
        raw[i] = u32::MAX;
    }
    // The bits do not depend on the SIMD level, so the table is built with the widest one.
    let mut rounded = [0; LANES];
    ratios(lane, SimdLevel::widest(), &values, divisor, &mut rounded);
    for (i, &value) in rounded.iter().enumerate().filter(|&(i, _)| raw[i] != 0) {
        put(i, value);
    }
}
