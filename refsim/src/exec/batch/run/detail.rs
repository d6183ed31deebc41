//! Level of detail in rows: the levels that each lane reads, and the filter within them.
//!
//! Derivatives, their lengths and biases are computed in single precision, rounded after each step, as
//! [`crate::texture::lod_from_derivatives`] defines. The logarithm is the exponent plus a table lookup by the leading
//! bits of the fraction.

use super::slots::Slots;
use crate::exec::batch::lanes::{LANES, LaneRow, SimdLevel};
use crate::exec::batch::schedule::{FetchDetail, FetchStep};
use crate::texture::{Filter, Image, MipFilter, SampleRules, SamplerState, TextureKind};

/// Fraction bits of a single.
const FRACTION: u32 = 23;
/// Leading fraction bits that index the table. Intervals are narrower than the steps of 2^(1/256), so that none
/// contains two.
const LEADING: u32 = 9;
/// Maximum magnitude of a level of detail, in levels.
const FARTHEST: i32 = 128;

/// Table of `floor(2^bits log2 m)` for significands `m` from 1 to 2.
#[derive(Debug)]
struct LogTable {
    bits: u8,
    /// By leading bits of the fraction: the value at the start of the interval, and the fraction at which it increases
    /// by one.
    entries: Vec<(i32, u32)>,
}

impl LogTable {
    /// Creates the table for `bits` fraction bits, at most 8.
    ///
    /// The fraction at which the logarithm reaches `k 2^-bits` is rounded up from a product of at most eight roots of
    /// 2, in double precision. Its error is less than 2^-24 units in the last place of a single, and none of the 255
    /// numbers `2^(k/256)` is closer to a single than 2^-16 units.
    fn new(bits: u8) -> Self {
        let one = f64::from(1u32 << FRACTION);
        let steps = 1i32 << bits;
        let reached = |k: i32| {
            let (mut root, mut power) = (2.0_f64, one);
            for bit in (0..bits).rev() {
                root = root.sqrt();
                power *= if k >> bit & 1 == 1 { root } else { 1.0 };
            }
            power.ceil() as u32 - (1 << FRACTION)
        };
        let thresholds: Vec<u32> = (1..steps).map(reached).collect();
        let entry = |leading: u32| {
            let first = leading << (FRACTION - LEADING);
            let value = thresholds.partition_point(|&threshold| threshold <= first);
            ((value as u32).cast_signed(), thresholds.get(value).copied().unwrap_or(u32::MAX))
        };
        Self { bits, entries: (0..1 << LEADING).map(entry).collect() }
    }

    /// Computes log2(x) / 2 of a non-negative single, rounded down to the table's bits.
    #[inline(always)]
    fn half_log2(&self, x: f32) -> f32 {
        // Subnormal singles are normal doubles.
        let bits = f64::from(x).to_bits();
        let fraction = (bits >> (52 - FRACTION)) as u32 & ((1 << FRACTION) - 1);
        let (value, threshold) = self.entries[(fraction >> (FRACTION - LEADING)) as usize & ((1 << LEADING) - 1)];
        let exponent = (bits >> 52) as i32 - 1023;
        let whole = (exponent << self.bits) + value + i32::from(fraction >= threshold);
        let finite = (whole >> 1) as f32 * (1.0 / (1u32 << self.bits) as f32);
        let large = if x == f32::INFINITY { 127.0 } else { finite };
        let some = if x == 0.0 { -127.0 } else { large };
        if x.is_nan() { 0.0 } else { some }
    }
}

/// Parameters of level selection of a sampler.
#[derive(Debug)]
pub(super) struct LevelChoice {
    log: LogTable,
    state: SamplerState,
    /// Factors by axis that convert derivatives to texels of level 0.
    scales: Vec<f32>,
    last: i32,
}

/// Levels read by each lane.
#[derive(Debug)]
pub(super) struct PickedLevels {
    pub(super) first: LaneRow,
    /// Weight of the next level, in units of `2^-lod_fraction_bits`.
    pub(super) weight: LaneRow,
    /// 1 for the minification filter, 0 for the magnification filter.
    pub(super) smaller: LaneRow,
}

impl LevelChoice {
    /// Creates the parameters; `None` for cube maps, whose derivatives depend on the face.
    pub(super) fn new(image: &Image, state: &SamplerState, rules: &SampleRules) -> Option<Self> {
        let sizes = [image.width(), image.height(), image.slices()];
        let axes = match image.kind() {
            TextureKind::D1 => 1,
            TextureKind::D2 | TextureKind::Rectangle => 2,
            TextureKind::Volume => 3,
            TextureKind::Cube => return None,
        };
        let scale = |size: &u32| if image.kind() == TextureKind::Rectangle { 1.0 } else { *size as f32 };
        Some(Self {
            log: LogTable::new(rules.lod_fraction_bits.min(8)),
            state: *state,
            scales: sizes[..axes].iter().map(scale).collect(),
            last: (image.levels().len() as u32).cast_signed() - 1,
        })
    }

    /// Fraction bits of the level of detail.
    pub(super) fn bits(&self) -> u8 {
        self.log.bits
    }

    /// The minification filter if `smaller`, else the magnification filter.
    pub(super) fn filter(&self, smaller: bool) -> Filter {
        if smaller { self.state.min } else { self.state.mag }
    }

    /// Selects the levels of all lanes.
    pub(super) fn pick(&self, step: &FetchStep, slots: &Slots, simd: SimdLevel) -> PickedLevels {
        let mut squares = [[0.0_f32; LANES]; 2];
        for (axis, &scale) in self.scales.iter().enumerate() {
            let add = |square: &mut [f32; LANES], low: &LaneRow, high: Option<usize>| {
                simd.run(
                    #[inline(always)]
                    || match high {
                        Some(bit) => add_difference(low, bit, scale, axis == 0, square),
                        None => add_square(low, scale, axis == 0, square),
                    },
                );
            };
            match &step.detail {
                FetchDetail::Gradients(x, y) => {
                    add(&mut squares[0], slots.row(x[axis]), None);
                    add(&mut squares[1], slots.row(y[axis]), None);
                }
                FetchDetail::Implicit | FetchDetail::Biased(_) => {
                    add(&mut squares[0], slots.row(step.coordinates[axis]), Some(1));
                    add(&mut squares[1], slots.row(step.coordinates[axis]), Some(16));
                }
            }
        }
        let bias = if let FetchDetail::Biased(bias) = step.detail { Some(slots.row(bias)) } else { None };
        let mut picked = PickedLevels { first: [0; LANES], weight: [0; LANES], smaller: [0; LANES] };
        simd.run(
            #[inline(always)]
            || self.levels(&squares, bias, &mut picked),
        );
        picked
    }

    #[inline(always)]
    fn levels(&self, [along_x, along_y]: &[[f32; LANES]; 2], bias: Option<&LaneRow>, out: &mut PickedLevels) {
        let bits = u32::from(self.log.bits);
        let one = f64::from(1u32 << bits);
        let farthest = f64::from(FARTHEST << bits);
        let first = i32::from(self.state.max_mip_level).min(self.last);
        let lod_bias = f32::from_bits(self.state.lod_bias);
        for i in 0..LANES {
            let (x, y) = (along_x[i], along_y[i]);
            let longer = if x > y { x } else { y };
            let level = self.log.half_log2(if x.is_nan() { x } else { longer });
            let biased = match bias {
                Some(bias) => level + f32::from_bits(bias[i]),
                None => level,
            };
            let wanted = f64::from(biased + lod_bias);
            let steps = (wanted * one).floor();
            let low = if steps > -farthest { steps } else { -farthest };
            let tamed = if low < farthest { low } else { farthest };
            let lambda = if wanted.is_nan() { 0 } else { tamed as i32 };
            let (level, weight) = match self.state.mip {
                MipFilter::None => (first, 0),
                MipFilter::Nearest => (((lambda + (1 << bits >> 1)) >> bits).max(first).min(self.last), 0),
                MipFilter::Linear => {
                    let clamped = lambda.max(first << bits).min(self.last << bits);
                    (clamped >> bits, clamped & ((1 << bits) - 1))
                }
            };
            out.first[i] = level.cast_unsigned();
            out.weight[i] = weight.cast_unsigned();
            out.smaller[i] = u32::from(lambda > 0);
        }
    }
}

/// Adds the square of a derivative in texels; `begins` for the first term.
#[inline(always)]
fn add_square(derivative: &LaneRow, scale: f32, begins: bool, sum: &mut [f32; LANES]) {
    for i in 0..LANES {
        let texels = f32::from_bits(derivative[i]) * scale;
        sum[i] = if begins { texels * texels } else { sum[i] + texels * texels };
    }
}

/// The same for the difference across a quad, between lanes whose indices differ in `bit`.
#[inline(always)]
fn add_difference(coordinate: &LaneRow, bit: usize, scale: f32, begins: bool, sum: &mut [f32; LANES]) {
    for i in 0..LANES {
        let across = f32::from_bits(coordinate[i | bit]) - f32::from_bits(coordinate[i & !bit]);
        let texels = across * scale;
        sum[i] = if begins { texels * texels } else { sum[i] + texels * texels };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{TexelFormat, lod_from_derivatives};

    /// Compares with `texture`: derivatives of every magnitude, along the single axis of a one-texel texture. Squares
    /// of singles cover few singles; the next test covers every significand.
    #[test]
    fn levels_are_those_of_the_texture_room() {
        let image = Image::new(TexelFormat::L8, TextureKind::D1, [1, 1, 1], 1).unwrap();
        for bits in 0..=8 {
            let table = LogTable::new(bits);
            for pattern in (0..=0x7f80_0001u32).step_by(9973).chain([0, 1, 0x7f7f_ffff, 0x7f80_0000, 0x7fc0_0000]) {
                let expected = lod_from_derivatives(&image, [0; 4], [pattern, 0, 0, 0], [0; 4], bits);
                let length = f32::from_bits(pattern);
                assert_eq!(table.half_log2(length * length).to_bits(), expected, "{pattern:#x}, {bits} bits");
            }
        }
    }

    /// Compares with squaring in integers with 62 bits kept, for all significands (one in eleven in the short form).
    #[test]
    fn every_significand_has_its_logarithm() {
        let step = if std::env::var_os("CROSSBAR_FULL").is_some() { 1 } else { 11 };
        let table = LogTable::new(8);
        for fraction in (0..1u32 << FRACTION).step_by(step) {
            let mut mantissa = u128::from(fraction | 1 << FRACTION) << (62 - FRACTION);
            let mut expected = 0;
            for _ in 0..8 {
                mantissa = (mantissa * mantissa) >> 62;
                let carry = mantissa >> 63;
                mantissa >>= carry;
                expected = 2 * expected + carry as i32;
            }
            for exponent in [0, 1] {
                let x = f32::from_bits(fraction | (127 + exponent) << FRACTION);
                let found = table.half_log2(x) * 256.0;
                assert_eq!(found as i32, (expected + (exponent << 8).cast_signed()) >> 1, "{x}");
            }
        }
    }
}
