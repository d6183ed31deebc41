//! Encoding of values for targets: texels of targets in rows, and depth patterns.

use refsim_lanes::{LANES, LaneRow};

use super::targets::{Coding, ColorRows, Packing};
use crate::exec::batch::formats::LaneFormats;
use crate::exec::lower::Arith;
use crate::num::FormatKind;
use crate::output::DepthFormat;
use crate::texture::TargetRounding;

/// Lanes that passed the tests before the depth test, and their depths in the depth buffer's format.
#[derive(Clone, Debug)]
pub(crate) struct Survivors {
    pub(crate) alive: LaneRow,
    pub(crate) count: u32,
    pub(crate) depth: LaneRow,
}

impl Survivors {
    pub(crate) fn new() -> Self {
        Self { alive: [0; LANES], count: 0, depth: [0; LANES] }
    }

    /// Sets the number of surviving lanes; returns the decrease.
    pub(crate) fn keep(&mut self, left: u32) -> u64 {
        let gone = self.count - left;
        self.count = left;
        gone.into()
    }
}

/// Up to this number of fragments, writing fragment by fragment is faster than encoding whole rows.
const FEW: u32 = 24;

pub(crate) fn write_lane(rows: &mut ColorRows, color: &[u32; 4], lane: usize, formats: &LaneFormats) {
    let main = formats.lane(Arith::Main).reading();
    if let Some(blender) = &rows.packing.blender {
        let mut old = [0; 4];
        old.iter_mut().zip(&rows.words).for_each(|(old, word)| *old = word[lane]);
        let new = blender.blend(color, old, rows.packing.channels.iter().map(|channel| channel.place), formats);
        for ((word, new), &bits) in rows.words.iter_mut().zip(new).zip(&rows.packing.written) {
            word[lane] = word[lane] & !bits | new;
        }
        return;
    }
    for (word, &bits) in rows.words.iter_mut().zip(&rows.packing.written) {
        word[lane] &= !bits;
    }
    for channel in &rows.packing.channels {
        let raw = color[channel.place.component];
        let value = match channel.coding {
            Coding::Steps(scale, half) => main.to_steps(raw, scale, half),
            Coding::Single => main.to_single(raw),
            Coding::Blended => 0,
        };
        rows.words[channel.place.word][lane] |= value << channel.place.shift;
    }
}

pub(crate) fn write_rows(rows: &mut ColorRows, colors: [&LaneRow; 4], survivors: &Survivors, formats: &LaneFormats) {
    if survivors.count <= FEW || rows.packing.blender.is_some() {
        for lane in (0..LANES).filter(|&l| survivors.alive[l] != 0) {
            write_lane(rows, &colors.map(|row| row[lane]), lane, formats);
        }
        return;
    }
    let (main, simd) = (formats.lane(Arith::Main).reading(), formats.simd());
    let Packing { channels, written, .. } = &rows.packing;
    let (mut texels, mut codes) = ([0; LANES], [0; LANES]);
    for (number, word) in rows.words.iter_mut().enumerate().filter(|&(i, _)| written[i] != 0) {
        texels.fill(0);
        for channel in channels.iter().filter(|c| c.place.word == number) {
            let row = colors[channel.place.component];
            match channel.coding {
                Coding::Steps(scale, half) => main.row_to_steps(simd, row, (scale, half), &mut codes),
                Coding::Single => main.row_to_singles(simd, row, &mut codes),
                Coding::Blended => continue,
            }
            let shift = channel.place.shift;
            simd.run(
                #[inline(always)]
                || {
                    for i in 0..LANES {
                        texels[i] |= codes[i] << shift;
                    }
                },
            );
        }
        let (alive, bits) = (&survivors.alive, written[number]);
        simd.run(
            #[inline(always)]
            || {
                for i in 0..LANES {
                    let mask = alive[i] & bits;
                    word[i] = (word[i] & !mask) | (texels[i] & mask);
                }
            },
        );
    }
}

/// Encodes values, clamped to [0, 1], as depth patterns.
///
/// In double precision, a value with at most 24 significant bits times 2^24 - 1 is exact, and so is the addition of one
/// half near a rounding boundary. Values with more bits and other depth formats are encoded by [`crate::output`].
pub(crate) fn quantise(
    (formats, arith): (&LaneFormats, Arith),
    depth: DepthFormat,
    rounding: TargetRounding,
    row: &LaneRow,
    out: &mut Survivors,
) {
    let (lane, format, simd) = (formats.lane(arith), formats.format(arith), formats.simd());
    let bits = match depth {
        DepthFormat::Unorm16 => 16,
        DepthFormat::Unorm24 => 24,
        _ => 0,
    };
    let nearest = rounding == TargetRounding::Nearest;
    let to = &mut out.depth;
    match format.kind {
        FormatKind::Fixed { frac_bits, .. } if bits > 0 && u32::from(frac_bits) <= bits => {
            return simd.run(
                #[inline(always)]
                || fixed_to_steps(row, frac_bits.into(), bits, nearest, to),
            );
        }
        FormatKind::Normalized { .. } | FormatKind::Float { .. } if bits > 0 => {
            let (scale, half) = (f64::from((1u32 << bits) - 1), if nearest { 0.5 } else { 0.0 });
            return lane.reading().row_to_steps(simd, row, (scale, half), to);
        }
        FormatKind::Float { .. } if depth == DepthFormat::Float32 => {
            return simd.run(
                #[inline(always)]
                || float_to_single(row, to),
            );
        }
        // At most 24 bits: exact in single precision.
        FormatKind::Fixed { frac_bits, .. } if depth == DepthFormat::Float32 && format.width() <= 24 => {
            return simd.run(
                #[inline(always)]
                || fixed_to_single(row, frac_bits.into(), to),
            );
        }
        _ => {}
    }
    for i in (0..LANES).filter(|&i| out.alive[i] != 0) {
        out.depth[i] = depth.quantise(format, lane.encode(row[i]), rounding);
    }
}

/// A fixed-point value `k / 2^F` in [0, 1] is `k 2^(n-F) - k / 2^F` steps of `1 / (2^n - 1)`; subtracting the fraction
/// lowers the result by one step if the fraction is more than the rounding adds.
#[inline(always)]
fn fixed_to_steps(row: &LaneRow, frac: u32, bits: u32, nearest: bool, out: &mut LaneRow) {
    let one = 1i32 << frac;
    let kept = if nearest { one } else { 0 };
    for i in 0..LANES {
        let k = row[i].cast_signed().clamp(0, one);
        out[i] = ((k << (bits - frac)) - i32::from(2 * k > kept)).cast_unsigned();
    }
}

#[inline(always)]
fn fixed_to_single(row: &LaneRow, frac: u32, out: &mut LaneRow) {
    let one = 1i32 << frac;
    for i in 0..LANES {
        out[i] = (row[i].cast_signed().clamp(0, one) as f32 / one as f32).to_bits();
    }
}

/// Slots store the numbers of every float format as host singles.
#[inline(always)]
fn float_to_single(row: &LaneRow, out: &mut LaneRow) {
    for i in 0..LANES {
        let x = f32::from_bits(row[i]);
        let low = if x > 0.0 { x } else { 0.0 };
        out[i] = if low < 1.0 { low } else { 1.0f32 }.to_bits();
    }
}
