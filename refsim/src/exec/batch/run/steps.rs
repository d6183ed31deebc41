//! Execution of scheduled steps.

use refsim_lanes::{LANES, LaneRow, Slots, div_odd_long};

use super::fetch::BatchTexture;
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::schedule::{BatchStep, StepBlock};
use crate::exec::lower::{Arith, Slot};
use crate::num::ops as definition;

/// Inputs of steps other than slots.
#[derive(Debug)]
pub(crate) struct Surroundings<'a> {
    pub(crate) formats: &'a LaneFormats,
    pub(crate) textures: &'a [Option<BatchTexture<'a>>],
    /// Raw float constants.
    pub(crate) constants: &'a [[u32; 4]],
}

pub(crate) fn fill_constants(block: &StepBlock, slots: &mut Slots) {
    for &slot in &block.without_row {
        slots.without_row(slot);
    }
    for &(slot, raw) in &block.constants {
        slots.fill(slot, raw);
    }
}

/// Executes steps. Texture reads that are not possible in rows are made for the lanes enabled in `run`.
pub(crate) fn run_steps(steps: &[BatchStep], around: &Surroundings<'_>, run: &LaneRow, slots: &mut Slots) {
    for step in steps {
        match step {
            BatchStep::Lanes(arith, lane_ops) => {
                refsim_lanes::run(around.formats.lane(*arith), around.formats.simd(), lane_ops, slots)
            }
            BatchStep::Sum { arith, sum, from, to } => {
                let (lane, format) = (around.formats.lane(*arith), around.formats.format(*arith));
                refsim_lanes::add_rows(format, lane, around.formats.simd(), *sum, (*from, *to), slots);
            }
            BatchStep::Unorm { steps, from } => to_steps(*steps, *from, slots),
            BatchStep::Fetch(fetch) => {
                if let Some(Some(texture)) = around.textures.get(fetch.sampler) {
                    texture.read(fetch, around.formats, run, slots);
                }
            }
            BatchStep::Circle { arith, sine, from, to } => circle(around.formats, *arith, *sine, (*from, *to), slots),
            BatchStep::Relative { base, component, address, to } => {
                for lane in 0..LANES {
                    let number = i64::from(*base) + i64::from(slots.row(*address)[lane].cast_signed());
                    let constant = usize::try_from(number).ok().and_then(|n| around.constants.get(n));
                    slots.row_mut(*to)[lane] = constant.map_or(0, |c| c[*component]);
                }
            }
        }
    }
}

/// Computes cosines or sines with [`crate::num`]: a vectorised version would not be worth the effort of proving it.
fn circle(formats: &LaneFormats, arith: Arith, sine: bool, (from, to): (Slot, Slot), slots: &mut Slots) {
    let (format, lane) = (formats.format(arith), formats.lane(arith));
    let value = |bits| if sine { definition::sin(format, bits).bits } else { definition::cos(format, bits).bits };
    let mut last = (0, value(0));
    for i in 0..LANES {
        let bits = lane.encode(slots.row(from)[i]);
        if bits != last.0 {
            last = (bits, value(bits));
        }
        slots.row_mut(to)[i] = lane.decode(last.1);
    }
}

/// Clamps values to [0, 1] and rounds them to multiples of 1 / steps, halves up. Stores the fractions, rounded to odd,
/// in the wide row.
fn to_steps(steps: u32, from: u16, slots: &mut Slots) {
    let count = f64::from(steps);
    for i in 0..LANES {
        let x = f64::from(f32::from_bits(slots.row(from)[i]));
        let low = if x > 0.0 { x } else { 0.0 };
        let clamped = if low < 1.0 { low } else { 1.0 };
        // 24 and 16 bits: the product is exact, and so is the sum near an integer.
        slots.wide_mut()[i] = div_odd_long((clamped * count + 0.5).floor(), count);
    }
}

/// Converts float constants to raw values.
pub(crate) fn raw_constants(constants: &[[u32; 4]], formats: &LaneFormats) -> Vec<[u32; 4]> {
    let lane = formats.lane(Arith::Main);
    constants.iter().map(|c| c.map(|bits| lane.decode(bits))).collect()
}
