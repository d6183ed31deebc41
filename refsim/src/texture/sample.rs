//! Sampling: computes a filtered value in the register format from coordinates.

use serde::Deserialize;

use super::address::{AddressMode, cube_coordinates, linear_taps, nearest_index};
use super::lod::Lod;
use super::value;
use super::{ChannelValue, FilterArithmetic, Image, SampleRules, SampledComponent, TextureKind};
use crate::num::{self, Format};

/// Filter within a mip level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// The nearest texel.
    #[default]
    Nearest,
    /// Linear interpolation between the nearest two texels per axis.
    Linear,
}

/// Filter between mip levels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MipFilter {
    /// Only the finest level that may be read is used.
    #[default]
    None,
    /// The nearest level.
    Nearest,
    /// Linear interpolation between the nearest two levels.
    Linear,
}

/// The state of a sampler.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SamplerState {
    /// Minification filter (level of detail above 0).
    pub min: Filter,
    /// Magnification filter.
    pub mag: Filter,
    /// Filter between levels.
    pub mip: MipFilter,
    /// Addressing along the first axis.
    pub address_u: AddressMode,
    /// Addressing along the second axis.
    pub address_v: AddressMode,
    /// Addressing along the third axis.
    pub address_w: AddressMode,
    /// Border colour, FP32 bits. Depending on the device's [`super::BorderStorage`], it is converted to a texel of the
    /// image's format or rounded to four bytes.
    pub border: [u32; 4],
    /// Bias added to the level of detail, FP32 bits.
    pub lod_bias: u32,
    /// The finest level that may be read; 0 allows all.
    pub max_mip_level: u8,
}

impl SamplerState {
    /// Nearest filtering without mip levels and with clamped coordinates, for data textures.
    pub const NEAREST_CLAMP: Self = Self {
        min: Filter::Nearest,
        mag: Filter::Nearest,
        mip: MipFilter::None,
        address_u: AddressMode::Clamp,
        address_v: AddressMode::Clamp,
        address_w: AddressMode::Clamp,
        border: [0; 4],
        lod_bias: 0,
        max_mip_level: 0,
    };
}

/// The value of an unbound sampler: (0, 0, 0, 1).
pub fn unbound(format: Format) -> [u32; 4] {
    let one = value::ratio(format, 1, 1);
    [0, 0, 0, one]
}

/// Samples an image; `None` is an unbound sampler. Coordinates are FP32 bits, the result is in `rules.format`. The
/// steps are defined in docs/numbers.md, "Texels".
pub fn sample(
    image: Option<&Image>,
    state: &SamplerState,
    rules: &SampleRules,
    coordinates: [u32; 4],
    lod: Lod,
) -> [u32; 4] {
    let Some(image) = image else { return unbound(rules.format) };
    let place = SamplePlace::new(image, state, coordinates);
    let pick = place.pick_levels(rules, lod);
    if pick.filter == Filter::Nearest && pick.weight == 0 {
        return place.nearest_value(rules, pick.levels[0]);
    }
    if image.format().record().is_float() {
        place.filter_floats(rules, &pick)
    } else {
        place.filter_integers(rules, &pick)
    }
}

/// Calls `each` with the level, slice, row and column of every texel to which [`sample`] gives a weight above 0, in a
/// fixed order. The border is skipped.
pub fn touched(
    image: &Image,
    state: &SamplerState,
    rules: &SampleRules,
    coordinates: [u32; 4],
    lod: Lod,
    mut each: impl FnMut(u32, u32, u32, u32),
) {
    let place = SamplePlace::new(image, state, coordinates);
    let pick = place.pick_levels(rules, lod);
    let levels = if pick.weight == 0 { &pick.levels[..1] } else { &pick.levels[..] };
    for &level in levels {
        let taps = place.taps(rules, pick.filter, level);
        for corner in 0..8 {
            let index = |axis: usize| taps[axis].0[corner >> axis & 1];
            let weighs = (0..3).all(|axis| corner >> axis & 1 == 0 || taps[axis].1 != 0);
            if let (true, Some(slice), Some(y), Some(x)) = (weighs, index(2), index(1), index(0)) {
                each(level, slice, y, x);
            }
        }
    }
}

/// The levels to read, and the filter within them.
struct Pick {
    filter: Filter,
    levels: [u32; 2],
    /// Weight of the second level in units of `2^-lod_fraction_bits`; 0 without a second level.
    weight: u32,
}

/// The taps along each axis, and the weight of the second tap.
type Taps = [([Option<u32>; 2], u32); 3];

/// A sample point on an image: its sampler, coordinates along up to three axes, and cube face.
struct SamplePlace<'a> {
    image: &'a Image,
    state: &'a SamplerState,
    coordinates: [u32; 3],
    face: u32,
}

impl<'a> SamplePlace<'a> {
    fn new(image: &'a Image, state: &'a SamplerState, [x, y, z, _]: [u32; 4]) -> Self {
        let (coordinates, face) = match image.kind() {
            TextureKind::Cube => {
                let (face, u, v) = cube_coordinates([x, y, z]);
                ([u, v, 0], face as u32)
            }
            _ => ([x, y, z], 0),
        };
        Self { image, state, coordinates, face }
    }

    fn axes(&self) -> usize {
        match self.image.kind() {
            TextureKind::D1 => 1,
            TextureKind::D2 | TextureKind::Rectangle | TextureKind::Cube => 2,
            TextureKind::Volume => 3,
        }
    }

    /// Address mode, extent and coordinate scale of an axis at a level.
    fn axis(&self, level: u32, axis: usize) -> (AddressMode, u32, u32) {
        let l = self.image.levels()[level as usize];
        let size = [l.width, l.height, l.slices][axis];
        let asked = [self.state.address_u, self.state.address_v, self.state.address_w][axis];
        match self.image.kind() {
            TextureKind::Cube => (AddressMode::Clamp, size, size),
            TextureKind::Rectangle if asked == AddressMode::Border => (AddressMode::Border, size, 1),
            TextureKind::Rectangle => (AddressMode::Clamp, size, 1),
            _ => (asked, size, size),
        }
    }

    /// Slice, row and column of the nearest texel of a level.
    fn nearest(&self, level: u32) -> Option<(u32, u32, u32)> {
        let mut index = [0, 0, self.face];
        for (axis, slot) in index.iter_mut().enumerate().take(self.axes()) {
            let (mode, size, scale) = self.axis(level, axis);
            *slot = nearest_index(mode, self.coordinates[axis], size, scale)?;
        }
        Some((index[2], index[1], index[0]))
    }

    fn nearest_value(&self, rules: &SampleRules, level: u32) -> [u32; 4] {
        let texel = match self.nearest(level) {
            Some(at) => self.texel(rules, level, at),
            None => self.border(rules),
        };
        texel.map(|component| component.value(rules).to_format(rules.format))
    }

    /// Taps along each axis of a level. Unused axes have one tap of full weight.
    fn taps(&self, rules: &SampleRules, filter: Filter, level: u32) -> Taps {
        let (bits, rounding) = (rules.filter_fraction_bits, rules.filter_weight_rounding);
        let mut taps = [([Some(0), None], 0), ([Some(0), None], 0), ([Some(self.face), None], 0)];
        for (axis, slot) in taps.iter_mut().enumerate().take(self.axes()) {
            let (mode, size, scale) = self.axis(level, axis);
            *slot = match filter {
                Filter::Nearest => ([nearest_index(mode, self.coordinates[axis], size, scale), None], 0),
                Filter::Linear => linear_taps(mode, self.coordinates[axis], size, scale, bits, rounding),
            };
        }
        taps
    }

    fn texel(&self, rules: &SampleRules, level: u32, (slice, y, x): (u32, u32, u32)) -> [SampledComponent; 4] {
        rules.texel(self.image.format(), self.image.raw(level, slice, y, x))
    }

    fn border(&self, rules: &SampleRules) -> [SampledComponent; 4] {
        rules.border(self.image.format(), self.state.border)
    }

    fn pick_levels(&self, rules: &SampleRules, lod: Lod) -> Pick {
        let (image, state) = (self.image, self.state);
        let bits = u32::from(rules.lod_fraction_bits.min(8));
        let wanted = match lod {
            Lod::Base => state.lod_bias,
            Lod::Level(level) => value::add(level, state.lod_bias),
        };
        let lambda = if value::is_nan(wanted) || wanted & 0x7fff_ffff == 0 {
            0
        } else if value::is_not_finite(wanted) {
            if value::is_negative(wanted) { -(128 << bits) } else { 128 << bits }
        } else {
            value::scaled_floor(wanted, 1, bits, false).clamp(-(128 << bits), 128 << bits)
        };
        let filter = if lambda > 0 { state.min } else { state.mag };
        let last = i64::from(image.levels().len() as u32) - 1;
        let first = i64::from(state.max_mip_level).min(last);
        let (level, weight) = match state.mip {
            MipFilter::None => (first, 0),
            // Half a step is added, so that the floor rounds to the nearest level.
            MipFilter::Nearest => (((lambda + ((1 << bits) >> 1)) >> bits).clamp(first, last), 0),
            MipFilter::Linear => {
                // The integer part selects the level; the fraction is the weight of the next level.
                let clamped = lambda.clamp(first << bits, last << bits);
                (clamped >> bits, clamped & ((1 << bits) - 1))
            }
        };
        Pick { filter, levels: [level as u32, (level + 1).min(last) as u32], weight: weight as u32 }
    }

    /// The texel of tap `corner` (bit 0 along x, bit 1 along y, bit 2 along z).
    fn corner_texel(&self, rules: &SampleRules, level: u32, taps: &Taps, corner: usize) -> [SampledComponent; 4] {
        let index = |axis: usize| taps[axis].0[corner >> axis & 1];
        match (index(2), index(1), index(0)) {
            (Some(slice), Some(y), Some(x)) => self.texel(rules, level, (slice, y, x)),
            _ => self.border(rules),
        }
    }

    /// Filters fixed-point texels: bytes by the device's filter arithmetic, other components as an exact sum.
    fn filter_integers(&self, rules: &SampleRules, pick: &Pick) -> [u32; 4] {
        let sums = self.exact_sums(rules, pick);
        if rules.filter_arithmetic == FilterArithmetic::Exact {
            return sums;
        }
        let byte = |component| if let SampledComponent::Byte { byte, .. } = component { byte } else { 0 };
        let bytes = self.interpolate(rules, pick, |texel| texel.map(byte), lerp_bytes);
        // If a component is a byte in the border, it is a byte in every texel too.
        let border = self.border(rules);
        [0, 1, 2, 3].map(|i: usize| match border[i] {
            SampledComponent::Byte { signed, .. } => {
                SampledComponent::Byte { byte: bytes[i], signed }.value(rules).to_format(rules.format)
            }
            SampledComponent::Value(_) => sums[i],
        })
    }

    /// Exact weighted sums, rounded once.
    fn exact_sums(&self, rules: &SampleRules, pick: &Pick) -> [u32; 4] {
        let bits = rules.filter_fraction_bits.min(12);
        let lod_bits = u32::from(rules.lod_fraction_bits.min(8));
        let mut sums = [0i64; 4];
        let mut denominators = [1u64; 4];
        let level_weights = [(1u64 << lod_bits) - u64::from(pick.weight), u64::from(pick.weight)];
        for (level, level_weight) in pick.levels.into_iter().zip(level_weights) {
            if level_weight == 0 {
                continue;
            }
            let taps = self.taps(rules, pick.filter, level);
            for corner in 0..8 {
                let weight = (0..3).fold(level_weight, |product, axis| {
                    let second = u64::from(taps[axis].1);
                    product * if corner >> axis & 1 == 1 { second } else { (1 << bits) - second }
                });
                if weight == 0 {
                    continue;
                }
                let texel = self.corner_texel(rules, level, &taps, corner);
                for (i, component) in texel.into_iter().enumerate() {
                    if let ChannelValue::Ratio { numerator, denominator } = component.value(rules) {
                        sums[i] += weight.cast_signed() * numerator;
                        denominators[i] = u64::from(denominator);
                    }
                }
            }
        }
        // Total fraction bits of the weights of three axes and of the level.
        let shift = 3 * u32::from(bits) + lod_bits;
        [0, 1, 2, 3].map(|i| value::ratio(rules.format, sums[i], denominators[i] << shift))
    }

    /// Interpolates float texels in FP32 steps.
    fn filter_floats(&self, rules: &SampleRules, pick: &Pick) -> [u32; 4] {
        let single = |component: SampledComponent| component.value(rules).to_format(Format::FP32);
        let result = self.interpolate(rules, pick, |texel| texel.map(single), lerp_singles);
        result.map(|bits| num::ops::convert(&Format::FP32, rules.format, bits).bits)
    }

    /// Interpolates along x, y, z and between the levels. `lerp` takes a weight and its number of fraction bits.
    fn interpolate<T: Copy + Default>(
        &self,
        rules: &SampleRules,
        pick: &Pick,
        texel: impl Fn([SampledComponent; 4]) -> T,
        lerp: impl Fn(T, T, u32, u8) -> T,
    ) -> T {
        let bits = rules.filter_fraction_bits.min(12);
        let at_level = |level: u32| {
            let taps = self.taps(rules, pick.filter, level);
            let weights = [0, 1, 2].map(|axis: usize| taps[axis].1);
            let mut values = [T::default(); 8];
            for (corner, out) in values.iter_mut().enumerate() {
                if (0..3).all(|axis| corner >> axis & 1 == 0 || weights[axis] != 0) {
                    *out = texel(self.corner_texel(rules, level, &taps, corner));
                }
            }
            for (axis, &weight) in weights.iter().enumerate() {
                for pair in 0..4 >> axis {
                    values[pair] = lerp(values[2 * pair], values[2 * pair + 1], weight, bits);
                }
            }
            values[0]
        };
        let first = at_level(pick.levels[0]);
        if pick.weight == 0 {
            return first;
        }
        lerp(first, at_level(pick.levels[1]), pick.weight, rules.lod_fraction_bits.min(8))
    }
}

/// `a + w * (b - a)` for a weight in units of `2^-bits`; `a` itself for weight 0.
fn lerp_singles(a: [u32; 4], b: [u32; 4], weight: u32, bits: u8) -> [u32; 4] {
    if weight == 0 {
        return a;
    }
    let w = value::from_fixed(i64::from(weight), bits);
    [0, 1, 2, 3].map(|i| value::add(a[i], value::mul(w, value::sub(b[i], a[i]))))
}

/// `a + w * (b - a)` of integers for a weight in units of `2^-bits`, rounded to the nearest integer, halves up.
fn lerp_bytes(a: [i32; 4], b: [i32; 4], weight: u32, bits: u8) -> [i32; 4] {
    let half = (1 << bits) >> 1;
    [0, 1, 2, 3].map(|i| a[i] + (((b[i] - a[i]) * weight.cast_signed() + half) >> bits))
}
