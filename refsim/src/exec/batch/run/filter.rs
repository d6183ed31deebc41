//! Filtered reads in rows: one level of a texture of any kind, nearest or linear, wherever the level of detail decides
//! nothing.
//!
//! Every lane's texels and weights come first (`address`), then, component by component, what they add up to: integer
//! texels as an exact sum that is rounded once, floats in the steps of single precision that the texture room defines.

use super::address::{AxisTaps, TexelAxis, cube, linear};
use super::channel::{channel_in_slot, channel_of, ratios};
use super::slots::Slots;
use super::table::MAX_TABLE_TEXELS;
use crate::exec::SamplerBinding;
use crate::exec::batch::lanes::{AnyLane, LANES, LaneFormats, LaneRow, SimdLevel, with_any_lane};
use crate::exec::batch::schedule::FetchStep;
use crate::exec::lower::Arith;
use crate::num::Format;
use crate::texture::{
    AddressMode, Channel, ChannelClass, ChannelValue, ComponentSource, Filter, Image, MipFilter, SampleRules,
    TargetRounding, TextureKind, decode_channel, encode,
};

/// The number of a texel of the border.
const BORDER: u32 = u32::MAX;
/// Bits of the widest channel of integers whose sums are exact: weights of three axes have 36 bits, a double 53.
const WIDEST: u8 = 16;

/// A level that is read in rows, and how.
#[derive(Debug)]
pub(crate) struct FilteredLevel {
    kind: TextureKind,
    axes: [TexelAxis; 3],
    /// Texels of a slice.
    slice: u32,
    /// Fraction bits of weights; 0 takes the first texel alone.
    bits: u8,
    components: [FilteredComponent; 4],
    /// By texel and component: the numerator, or the single; none of a large level.
    texels: Option<Vec<[u32; 4]>>,
    border: [u32; 4],
    /// The first byte of the level, and its texels.
    start: usize,
    count: usize,
}

/// What a component of the result is made of.
#[derive(Clone, Copy, Debug)]
enum FilteredComponent {
    /// As slots hold it.
    Constant(u32),
    /// Numerators over this.
    Ratio(Channel, f64),
    Single(Channel),
}

impl FilteredComponent {
    fn new(source: ComponentSource, binding: &SamplerBinding<'_>, rules: &SampleRules, lane: &AnyLane) -> Option<Self> {
        let channel = match source {
            ComponentSource::Zero => {
                return Some(Self::Constant(channel_in_slot(ChannelValue::ZERO, rules.format, lane)));
            }
            ComponentSource::One => {
                return Some(Self::Constant(channel_in_slot(ChannelValue::ONE, rules.format, lane)));
            }
            ComponentSource::Channel(i) => binding.image.format().record().channels[usize::from(i)],
        };
        match (channel.class, decode_channel(channel, 0, rules.signed_texel_minimum)) {
            (ChannelClass::Float(_), _) => Some(Self::Single(channel)),
            (_, ChannelValue::Ratio { denominator, .. }) if channel.bits <= WIDEST => {
                Some(Self::Ratio(channel, denominator.into()))
            }
            _ => None,
        }
    }

    /// The numerator or the single of a stored texel.
    fn decode(self, texel: &[u8], rules: &SampleRules) -> u32 {
        let (Self::Ratio(channel, _) | Self::Single(channel)) = self else { return 0 };
        match decode_channel(channel, channel_of(channel, texel), rules.signed_texel_minimum) {
            ChannelValue::Ratio { numerator, .. } => (numerator as i32).cast_unsigned(),
            float @ ChannelValue::Float { .. } => float.to_format(Format::FP32),
        }
    }
}

impl FilteredLevel {
    /// Prepares a binding; `None` where the level of detail decides.
    pub(crate) fn new(binding: &SamplerBinding<'_>, rules: &SampleRules, lane: &AnyLane) -> Option<Self> {
        let SamplerBinding { image, state } = binding;
        if binding.needs_detail() {
            return None;
        }
        let record = image.format().record();
        let mut components = [FilteredComponent::Constant(0); 4];
        for (component, source) in components.iter_mut().zip(record.components) {
            *component = FilteredComponent::new(source, binding, rules, lane)?;
        }
        let mixed = record.stored().iter().any(|c| matches!(c.class, ChannelClass::Float(_))) != record.is_float();
        if mixed {
            return None;
        }
        // With a mip filter there is one level.
        let last = image.levels().len() - 1;
        let number = if state.mip == MipFilter::None { usize::from(state.max_mip_level).min(last) } else { 0 };
        let level = image.levels()[number];
        let bits = if state.min == Filter::Linear { rules.filter_fraction_bits.min(12) } else { 0 };
        let axis = |size: u32, asked| match image.kind() {
            TextureKind::Cube => TexelAxis { size, scale: size.into(), mode: AddressMode::Clamp },
            TextureKind::Rectangle if asked != AddressMode::Border => {
                TexelAxis { size, scale: 1.0, mode: AddressMode::Clamp }
            }
            TextureKind::Rectangle => TexelAxis { size, scale: 1.0, mode: asked },
            _ => TexelAxis { size, scale: size.into(), mode: asked },
        };
        let raw = encode(image.format(), Format::FP32, state.border, TargetRounding::Nearest).to_le_bytes();
        let mut made = Self {
            kind: image.kind(),
            axes: [
                axis(level.width, state.address_u),
                axis(level.height, state.address_v),
                axis(level.slices, state.address_w),
            ],
            slice: level.width * level.height,
            bits,
            components,
            texels: None,
            border: components.map(|c| c.decode(&raw[..image.format().bytes()], rules)),
            start: level.offset,
            count: level.width as usize * level.height as usize * level.slices as usize,
        };
        if !made.is_large() {
            made.texels = Some(made.stored(image).map(|texel| components.map(|c| c.decode(texel, rules))).collect());
        }
        Some(made)
    }

    /// Whether its texels are decoded as they are read.
    pub(crate) fn is_large(&self) -> bool {
        self.count > MAX_TABLE_TEXELS
    }

    /// The texels of the level, slice by slice, row by row.
    fn stored<'i>(&self, image: &'i Image) -> impl Iterator<Item = &'i [u8]> {
        image.bytes()[self.start..].chunks_exact(image.format().bytes()).take(self.count)
    }

    /// Reads texels into the slots of the step; a large image's for the lanes that `run` names.
    pub(crate) fn read(
        &self,
        (image, rules): (&Image, &SampleRules),
        step: &FetchStep,
        formats: &LaneFormats,
        (run, slots): (&LaneRow, &mut Slots),
    ) {
        let source = TexelSource { level: self, image, rules, run };
        match (self.bits, self.kind) {
            (0, TextureKind::D1) => self.read_axes::<1, 1>(&source, step, formats, slots),
            (0, TextureKind::Volume) => self.read_axes::<3, 1>(&source, step, formats, slots),
            (0, _) => self.read_axes::<2, 1>(&source, step, formats, slots),
            (_, TextureKind::D1) => self.read_axes::<1, 2>(&source, step, formats, slots),
            (_, TextureKind::Volume) => self.read_axes::<3, 8>(&source, step, formats, slots),
            (_, _) => self.read_axes::<2, 4>(&source, step, formats, slots),
        }
    }

    /// [`Self::read`] along `AXES` axes, of whose texels `CORNERS` are combined.
    fn read_axes<const AXES: usize, const CORNERS: usize>(
        &self,
        source: &TexelSource<'_>,
        step: &FetchStep,
        formats: &LaneFormats,
        slots: &mut Slots,
    ) {
        let (simd, lane) = (formats.simd(), formats.lane(Arith::Main));
        let mut taps = [AxisTaps::ZERO; AXES];
        let mut numbers = [[0; LANES]; CORNERS];
        self.place(step.coordinates.map(|slot| slots.row(slot)), simd, &mut taps, &mut numbers);
        // Units of weights of all axes; a power of two, and so is its reciprocal.
        let unit = 1.0 / (1u64 << (usize::from(self.bits) * AXES)) as f64;
        let mut weights = [[1.0; LANES]; CORNERS];
        let integers = self.components.iter().any(|c| matches!(c, FilteredComponent::Ratio(..)));
        if CORNERS > 1 && integers {
            simd.run(
                #[inline(always)]
                || corner_weights(&taps, self.bits, &mut weights),
            );
        }
        for (c, to) in step.to.iter().enumerate() {
            let Some(to) = *to else { continue };
            let (mut row, mut result) = ([0; LANES], [0.0; LANES]);
            let divisor = match self.components[c] {
                FilteredComponent::Constant(raw) => {
                    slots.row_mut(to).fill(raw);
                    continue;
                }
                FilteredComponent::Ratio(_, denominator) => {
                    for (numbers, weights) in numbers.iter().zip(&weights) {
                        source.gather(c, numbers, &mut row);
                        simd.run(
                            #[inline(always)]
                            || add_weighted(&row, weights, unit, &mut result),
                        );
                    }
                    denominator
                }
                FilteredComponent::Single(_) => {
                    let mut corners = [[0; LANES]; CORNERS];
                    for (corner, numbers) in corners.iter_mut().zip(&numbers) {
                        source.gather(c, numbers, corner);
                    }
                    simd.run(
                        #[inline(always)]
                        || combine(&mut corners, &taps, self.bits, &mut result),
                    );
                    1.0
                }
            };
            let out = slots.row_mut(to);
            with_any_lane!(lane, |lane| {
                simd.run(
                    #[inline(always)]
                    || ratios(lane, &result, divisor, out),
                )
            });
        }
    }

    /// The taps of every lane, and the numbers of the texels at their corners.
    fn place<const AXES: usize, const CORNERS: usize>(
        &self,
        [x, y, z, _]: [&LaneRow; 4],
        simd: SimdLevel,
        taps: &mut [AxisTaps; AXES],
        numbers: &mut [LaneRow; CORNERS],
    ) {
        let (mut face, mut u, mut v) = ([0; LANES], [0; LANES], [0; LANES]);
        let mut coordinates = [x, y, z];
        if self.kind == TextureKind::Cube {
            simd.run(
                #[inline(always)]
                || cube([x, y, z], &mut face, [&mut u, &mut v]),
            );
            coordinates = [&u, &v, z];
        }
        simd.run(
            #[inline(always)]
            || {
                for ((taps, axis), coordinate) in taps.iter_mut().zip(self.axes).zip(coordinates) {
                    linear(coordinate, axis, self.bits, taps);
                }
                let strides = [1, self.axes[0].size, self.slice];
                corner_numbers(taps, strides, (&face, self.slice), numbers);
            },
        );
    }
}

/// Where texels come from.
struct TexelSource<'t> {
    level: &'t FilteredLevel,
    image: &'t Image,
    rules: &'t SampleRules,
    run: &'t LaneRow,
}

impl TexelSource<'_> {
    /// A component of the texels of these numbers.
    fn gather(&self, component: usize, numbers: &LaneRow, out: &mut LaneRow) {
        let level = self.level;
        if let Some(texels) = &level.texels {
            for (value, &number) in out.iter_mut().zip(numbers) {
                *value = texels.get(number as usize).unwrap_or(&level.border)[component];
            }
            return;
        }
        let size = self.image.format().bytes();
        let bytes = self.image.bytes().get(level.start..).unwrap_or_default();
        for ((value, &number), &run) in out.iter_mut().zip(numbers).zip(self.run) {
            *value = match number {
                _ if run == 0 => 0,
                BORDER => level.border[component],
                _ => {
                    let texel = bytes.get(number as usize * size..).and_then(|bytes| bytes.get(..size));
                    texel.map_or(0, |texel| level.components[component].decode(texel, self.rules))
                }
            };
        }
    }
}

/// The numbers of the texels at the corners (bit `a` of a corner: the second tap along axis `a`), those of `face`
/// further on by as many slices.
#[inline(always)]
fn corner_numbers<const AXES: usize, const CORNERS: usize>(
    taps: &[AxisTaps; AXES],
    strides: [u32; 3],
    (face, slice): (&LaneRow, u32),
    out: &mut [LaneRow; CORNERS],
) {
    for (corner, out) in out.iter_mut().enumerate() {
        for i in 0..LANES {
            let (mut number, mut inside) = (face[i].wrapping_mul(slice), true);
            for axis in 0..AXES {
                let texel = taps[axis].texels[corner >> axis & 1][i];
                inside &= texel >= 0;
                number = number.wrapping_add(texel.cast_unsigned().wrapping_mul(strides[axis]));
            }
            out[i] = if inside { number } else { BORDER };
        }
    }
}

/// The weights of the corners, in units of the filter to the power of the number of axes: integers of at most 36 bits.
#[inline(always)]
fn corner_weights<const AXES: usize, const CORNERS: usize>(
    taps: &[AxisTaps; AXES],
    bits: u8,
    out: &mut [[f64; LANES]; CORNERS],
) {
    let one = 1i32 << bits;
    for (corner, out) in out.iter_mut().enumerate() {
        for (i, out) in out.iter_mut().enumerate() {
            let mut weight = 1.0;
            for (axis, taps) in taps.iter().enumerate() {
                let second = taps.weight[i];
                weight *= f64::from(if corner >> axis & 1 == 1 { second } else { one - second });
            }
            *out = weight;
        }
    }
}

/// Adds weight times numerator, in units of `unit`, a power of two. Weights add up to at most 2^36 and numerators have
/// 16 bits and a sign: products and sums are integers of at most 2^52, exact in doubles, times a power of two.
#[inline(always)]
fn add_weighted(numerators: &LaneRow, weights: &[f64; LANES], unit: f64, sum: &mut [f64; LANES]) {
    for i in 0..LANES {
        sum[i] += (weights[i] * unit) * f64::from(numerators[i].cast_signed());
    }
}

/// Singles at the corners combined along one axis after the other: `a + w (b - a)`, every step rounded, and `a` itself
/// where the weight is 0. A weight has at most 12 bits: exact.
#[inline(always)]
fn combine<const AXES: usize, const CORNERS: usize>(
    corners: &mut [LaneRow; CORNERS],
    taps: &[AxisTaps; AXES],
    bits: u8,
    out: &mut [f64; LANES],
) {
    let share = 1.0 / (1u32 << bits) as f32;
    let mut left = CORNERS;
    for taps in taps.iter().take(if CORNERS == 1 { 0 } else { AXES }) {
        left /= 2;
        for pair in 0..left {
            let (first, second) = (corners[2 * pair], corners[2 * pair + 1]);
            for (i, into) in corners[pair].iter_mut().enumerate() {
                let (a, b) = (f32::from_bits(first[i]), f32::from_bits(second[i]));
                let between = a + taps.weight[i] as f32 * share * (b - a);
                *into = (if taps.weight[i] == 0 { a } else { between }).to_bits();
            }
        }
    }
    for (out, &value) in out.iter_mut().zip(&corners[0]) {
        *out = f64::from(f32::from_bits(value));
    }
}
