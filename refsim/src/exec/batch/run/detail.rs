//! Level of detail in rows: the levels that each lane reads, and the filter within them.
//!
//! Derivatives, their lengths and biases are computed in single precision, rounded after each step as defined by
//! [`crate::texture::lod_from_derivatives`]. The logarithm is the exponent plus a table lookup by the leading fraction
//! bits.

use refsim_lanes::{LANES, LaneRow, SimdLevel, Slots};

use super::log_table::LogTable;
use crate::exec::batch::schedule::{FetchDetail, FetchStep};
use crate::texture::{Filter, Image, MipFilter, SampleRules, SamplerState, TextureKind};

/// Maximum magnitude of a level of detail, in levels.
const FARTHEST: i32 = 128;

/// Parameters of level selection of a sampler.
#[derive(Debug)]
pub(super) struct LevelChoice {
    log: LogTable,
    state: SamplerState,
    /// Factors that convert derivatives to texels of level 0, by axis.
    scales: Vec<f32>,
    last: i32,
}

#[derive(Debug)]
pub(super) struct PickedLevels {
    pub(super) first: LaneRow,
    /// Weight of the next level, in units of `2^-lod_fraction_bits`.
    pub(super) weight: LaneRow,
    /// 1 for the minification filter, 0 for the magnification filter.
    pub(super) smaller: LaneRow,
}

impl LevelChoice {
    /// Creates the parameters; `None` for cube maps, whose derivatives depend on the cube face.
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

/// Adds the square of a derivative in texels to the sum; if `begins`, the square is the first term and starts the sum.
#[inline(always)]
fn add_square(derivative: &LaneRow, scale: f32, begins: bool, sum: &mut [f32; LANES]) {
    for i in 0..LANES {
        let texels = f32::from_bits(derivative[i]) * scale;
        sum[i] = if begins { texels * texels } else { sum[i] + texels * texels };
    }
}

/// Adds the square of the difference between the lanes of a quad whose indices differ in `bit`; `begins` as in
/// `add_square`.
#[inline(always)]
fn add_difference(coordinate: &LaneRow, bit: usize, scale: f32, begins: bool, sum: &mut [f32; LANES]) {
    for i in 0..LANES {
        let across = f32::from_bits(coordinate[i | bit]) - f32::from_bits(coordinate[i & !bit]);
        let texels = across * scale;
        sum[i] = if begins { texels * texels } else { sum[i] + texels * texels };
    }
}
