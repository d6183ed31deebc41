//! Texture reads of a batch: whole rows of nearest texels out of a table where that is all there is to do, the texture
//! room's own functions per lane otherwise.

use std::sync::Arc;

use super::channel::{channel_in_slot, channel_of, ratios};
use super::slots::Slots;
use super::stored::Stored;
use crate::exec::SamplerBinding;
use crate::exec::batch::cache::Cache;
use crate::exec::batch::lanes::{AnyLane, LANES, LaneFormats, LaneRow, SimdLevel, with_any_lane};
use crate::exec::batch::schedule::{FetchDetail, FetchStep};
use crate::exec::lower::Arith;
use crate::num::Format;
use crate::num::ops;
use crate::texture::{
    AddressMode, Channel, ChannelValue, ComponentSource, Image, Lod, SampleRules, SamplerState, TextureKind,
    decode_channel, fetch_nearest, lod_from_derivatives, sample,
};

/// Texels of the largest image that gets a table: 4 MiB of it. Those of larger ones are decoded as they are read.
const MAX_TABLE_TEXELS: usize = 1 << 18;
/// Texels up to which narrow channels are decoded one by one; where there are more, each of their codes is decoded
/// once.
const FEW_TEXELS: usize = 1024;
/// Coordinates from here on are even integers and address alike: stands for the larger ones.
const FAR: f64 = 16_777_216.0;

/// A bound texture, ready to be read by batches.
#[derive(Debug)]
pub(crate) struct BatchTexture<'a> {
    binding: SamplerBinding<'a>,
    rules: SampleRules,
    table: Option<Arc<TexelTable>>,
}

/// What a table is made from: the name of the texture's contents, the sampler's state, the device's rules.
pub(crate) type TableKey = (u64, SamplerState, SampleRules);

/// The tables last used, of textures whose contents have a name, which changes with them.
pub(crate) type TextureTables = Cache<TableKey, TexelTable>;

/// A plane that is read in rows.
#[derive(Debug)]
pub(crate) struct TexelTable {
    /// All texels in the register format, as slots hold them, the border texel last; of a large image the border texel
    /// alone.
    texels: Vec<[u32; 4]>,
    large: bool,
    width: u32,
    height: u32,
    /// What a coordinate of 1 is in texels.
    scale: [f64; 2],
    modes: [AddressMode; 2],
}

impl<'a> BatchTexture<'a> {
    /// Prepares the texture of a sampler.
    pub(crate) fn new(binding: SamplerBinding<'a>, rules: SampleRules, lane: &AnyLane, tables: &TextureTables) -> Self {
        let fit = TexelTable::fits(&binding);
        let make = || TexelTable::new(&binding, &rules, lane);
        let table = fit.then(|| match binding.image.contents_name() {
            Some(name) if !is_large(binding.image) => {
                let key = (name, binding.state, rules);
                tables.get(|known| *known == key, || (key, make()))
            }
            _ => Arc::new(make()),
        });
        Self { binding, rules, table }
    }

    /// Reads texels for the lanes that `run` names into the slots of the step.
    pub(crate) fn read(&self, step: &FetchStep, formats: &LaneFormats, run: &LaneRow, slots: &mut Slots) {
        match &self.table {
            Some(table) => {
                let mut index = [0u32; LANES];
                let (u, v) = (slots.row(step.coordinates[0]), slots.row(step.coordinates[1]));
                formats.simd().run(
                    #[inline(always)]
                    || table.indices(u, v, &mut index),
                );
                if table.large {
                    let stored = Stored::new(self.binding.image, &self.rules);
                    return stored.read(&index, &table.texels, step, formats, (run, slots));
                }
                for (c, to) in step.to.iter().enumerate() {
                    let Some(to) = *to else { continue };
                    for (value, &i) in slots.row_mut(to).iter_mut().zip(&index) {
                        *value = table.texels.get(i as usize).map_or(0, |t| t[c]);
                    }
                }
            }
            None => self.read_lanes(step, formats, run, slots),
        }
    }

    fn read_lanes(&self, step: &FetchStep, formats: &LaneFormats, run: &LaneRow, slots: &mut Slots) {
        let single = formats.lane(Arith::Single);
        // Lanes that are not run still take part in arithmetic: a number of the format, not what the slot held before.
        for to in step.to.iter().flatten() {
            slots.fill(*to, 0);
        }
        let vector = |slots: &Slots, from: &[u16; 4], lane: usize| from.map(|s| single.encode(slots.row(s)[lane]));
        for lane in (0..LANES).filter(|&l| run[l] != 0) {
            let at = |l: usize| vector(slots, &step.coordinates, l);
            let coordinates = at(lane);
            let bits = if self.binding.is_plain() {
                fetch_nearest(self.binding.image, &self.binding.state, &self.rules, coordinates)
            } else {
                let lod = if self.binding.needs_detail() {
                    let across = |bit: usize| {
                        let (low, high) = (at(lane & !bit), at(lane | bit));
                        std::array::from_fn(|i| ops::sub(Format::FP32, high[i], low[i]).bits)
                    };
                    let (ddx, ddy) = match &step.detail {
                        FetchDetail::Gradients(x, y) => (vector(slots, x, lane), vector(slots, y, lane)),
                        _ => (across(1), across(16)),
                    };
                    let level =
                        lod_from_derivatives(self.binding.image, coordinates, ddx, ddy, self.rules.lod_fraction_bits);
                    Lod::Level(match step.detail {
                        FetchDetail::Biased(bias) => {
                            ops::add(Format::FP32, level, single.encode(slots.row(bias)[lane])).bits
                        }
                        _ => level,
                    })
                } else {
                    Lod::Base
                };
                sample(Some(self.binding.image), &self.binding.state, &self.rules, coordinates, lod)
            };
            let main = formats.lane(Arith::Main);
            for (to, bits) in step.to.iter().zip(bits) {
                if let Some(to) = *to {
                    slots.row_mut(to)[lane] = main.decode(bits);
                }
            }
        }
    }
}

impl TexelTable {
    /// Whether a binding can be read out of a table.
    fn fits(binding: &SamplerBinding<'_>) -> bool {
        let image = binding.image;
        let plane = matches!(image.kind(), TextureKind::D1 | TextureKind::D2 | TextureKind::Rectangle);
        binding.is_plain() && plane
    }

    fn new(binding: &SamplerBinding<'_>, rules: &SampleRules, lane: &AnyLane) -> Self {
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
            // NaN addresses as 0: a read far outside gets the border colour.
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
        Self { texels, large, width, height, scale, modes }
    }

    /// The index of each lane's texel.
    #[inline(always)]
    fn indices(&self, u: &LaneRow, v: &LaneRow, out: &mut LaneRow) {
        let (mut x, mut y) = ([0i32; LANES], [0i32; LANES]);
        axis(u, self.scale[0], self.width, self.modes[0], &mut x);
        axis(v, self.scale[1], self.height, self.modes[1], &mut y);
        let (width, border) = (self.width.cast_signed(), (self.width * self.height).cast_signed());
        for i in 0..LANES {
            let inside = (x[i] >= 0) & (y[i] >= 0);
            out[i] = (if inside { y[i] * width + x[i] } else { border }).cast_unsigned();
        }
    }
}

/// Texel numbers along one axis; -1 for the border.
///
/// In doubles everything is exact: the product has 24 + 15 bits, and a position of less than 2^39 divided by a size of
/// less than 2^15 can't be rounded up to an integer that it doesn't reach.
#[inline(always)]
fn axis(coordinate: &LaneRow, scale: f64, size: u32, mode: AddressMode, out: &mut [i32; LANES]) {
    let n = f64::from(size);
    match mode {
        AddressMode::Clamp if scale == 1.0 => clamped(coordinate, size, out),
        AddressMode::Wrap => each(coordinate, scale, out, |p| p - (p / n).floor() * n),
        AddressMode::Mirror => each(coordinate, scale, out, |p| {
            let folded = p - (p / (2.0 * n)).floor() * (2.0 * n);
            if folded < n { folded } else { 2.0 * n - 1.0 - folded }
        }),
        AddressMode::Clamp => each(coordinate, scale, out, |p| {
            let above = if p > 0.0 { p } else { 0.0 };
            if above < n - 1.0 { above } else { n - 1.0 }
        }),
        AddressMode::Border => each(coordinate, scale, out, |p| if (p >= 0.0) & (p < n) { p } else { -1.0 }),
    }
}

/// Texel numbers of a rectangle's axis, clamped: coordinates are positions, and singles hold what becomes of them
/// exactly.
#[inline(always)]
fn clamped(coordinate: &LaneRow, size: u32, out: &mut [i32; LANES]) {
    // Less than 2^24, so exact.
    let last = (size - 1) as f32;
    for i in 0..LANES {
        let c = f32::from_bits(coordinate[i]);
        let finite = if c.abs() < f32::INFINITY { c } else { 0.0 };
        let above = if finite > 0.0 { finite } else { 0.0 };
        // Between 0 and the last, where cutting off is rounding down.
        out[i] = (if above < last { above } else { last }) as i32;
    }
}

/// Texel numbers by the position of a coordinate in texels, rounded down.
#[inline(always)]
fn each(coordinate: &LaneRow, scale: f64, out: &mut [i32; LANES], number: impl Fn(f64) -> f64) {
    for i in 0..LANES {
        let c = f64::from(f32::from_bits(coordinate[i]));
        let finite = if c.abs() < f64::INFINITY { c } else { 0.0 };
        let low = if finite > -FAR { finite } else { -FAR };
        let tamed = if low < FAR { low } else { FAR };
        out[i] = number((tamed * scale).floor()) as i32;
    }
}

/// Whether a table of an image's texels would be too large.
fn is_large(image: &Image) -> bool {
    image.width() as usize * image.height() as usize > MAX_TABLE_TEXELS
}

/// All texels of level 0 in the register format, as slots hold them, row by row.
fn all_texels(image: &Image, rules: &SampleRules, lane: &AnyLane) -> Vec<[u32; 4]> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let record = image.format().record();
    let mut texels = Vec::with_capacity(width * height + 1);
    texels.resize(width * height, [0; 4]);
    for (c, source) in record.components.into_iter().enumerate() {
        let channel = match source {
            ComponentSource::Channel(i) => record.channels[usize::from(i)],
            ComponentSource::Zero | ComponentSource::One => {
                let value = if source == ComponentSource::One { ChannelValue::ONE } else { ChannelValue::ZERO };
                let raw = channel_in_slot(value, rules.format, lane);
                texels.iter_mut().for_each(|texel| texel[c] = raw);
                continue;
            }
        };
        // Rows stand one after the other without a gap.
        let size = image.format().bytes();
        let start = image.offset_of(0, 0, 0, 0).unwrap_or_default();
        let bytes = image.bytes().get(start..).unwrap_or_default();
        if channel.bits <= 8 && texels.len() > FEW_TEXELS {
            let value =
                |bits| channel_in_slot(decode_channel(channel, bits, rules.signed_texel_minimum), rules.format, lane);
            let values: Vec<u32> = (0..1 << channel.bits).map(value).collect();
            for (texel, bytes) in texels.iter_mut().zip(bytes.chunks_exact(size)) {
                let bits = channel_of(channel, bytes) as usize & (values.len() - 1);
                texel[c] = values[bits];
            }
            continue;
        }
        for (texels, bytes) in texels.chunks_mut(LANES).zip(bytes.chunks(LANES * size)) {
            decode_block(channel, bytes.chunks_exact(size), rules, lane, |i, raw| {
                if let Some(texel) = texels.get_mut(i) {
                    texel[c] = raw;
                }
            });
        }
    }
    texels
}

/// One channel of up to 256 texels: ratios of up to 24 bits and single precision in rows, the rest one by one.
fn decode_block<'t>(
    channel: Channel,
    texels: impl Iterator<Item = &'t [u8]>,
    rules: &SampleRules,
    lane: &AnyLane,
    mut put: impl FnMut(usize, u32),
) {
    let mut values = [0.0; LANES];
    let mut raw = [0; LANES];
    let mut divisor = 1.0;
    let narrow = channel.bits <= 24;
    for (i, texel) in texels.take(LANES).enumerate() {
        let bits = channel_of(channel, texel);
        match decode_channel(channel, bits, rules.signed_texel_minimum) {
            ChannelValue::Ratio { numerator, denominator } if narrow => {
                values[i] = numerator as f64;
                divisor = f64::from(denominator);
            }
            ChannelValue::Float { format: Format::FP32, bits } => values[i] = f64::from(f32::from_bits(bits)),
            other => {
                put(i, channel_in_slot(other, rules.format, lane));
                continue;
            }
        }
        raw[i] = u32::MAX;
    }
    // Bits do not depend on the level, so the table is made with the widest there is.
    let mut rounded = [0; LANES];
    with_any_lane!(lane, |lane| {
        SimdLevel::widest().run(
            #[inline(always)]
            || ratios(lane, &values, divisor, &mut rounded),
        )
    });
    for (i, &value) in rounded.iter().enumerate().filter(|&(i, _)| raw[i] != 0) {
        put(i, value);
    }
}
