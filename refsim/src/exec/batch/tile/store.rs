//! Encoding of values for targets: texels of targets in rows, and depth patterns.

use super::targets::{Coding, ColorRows, PackedChannel, Packing};
use crate::exec::batch::lanes::{LANES, Lane, LaneFormats, LaneRow, with_any_lane};
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

    /// Sets the number of surviving lanes; returns how many fewer that is.
    pub(crate) fn keep(&mut self, left: u32) -> u64 {
        let gone = self.count - left;
        self.count = left;
        gone.into()
    }
}

/// Number of fragments up to which writing them one by one is faster than encoding whole rows.
const FEW: u32 = 24;

/// Writes one texel.
pub(crate) fn write_lane(rows: &mut ColorRows, color: &[u32; 4], lane: usize, formats: &LaneFormats) {
    let main = formats.lane(Arith::Main);
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
        let value = with_any_lane!(main, |l| { code(l, color[channel.place.component], channel.coding) });
        rows.words[channel.place.word][lane] |= value << channel.place.shift;
    }
}

/// Writes the texels of the surviving lanes.
pub(crate) fn write_rows(rows: &mut ColorRows, colors: [&LaneRow; 4], survivors: &Survivors, formats: &LaneFormats) {
    if survivors.count <= FEW || rows.packing.blender.is_some() {
        for lane in (0..LANES).filter(|&l| survivors.alive[l] != 0) {
            write_lane(rows, &colors.map(|row| row[lane]), lane, formats);
        }
        return;
    }
    let (main, simd) = (formats.lane(Arith::Main), formats.simd());
    let Packing { channels, written, .. } = &rows.packing;
    let mut texels = [0; LANES];
    for (number, word) in rows.words.iter_mut().enumerate().filter(|&(i, _)| written[i] != 0) {
        texels.fill(0);
        for channel in channels.iter().filter(|c| c.place.word == number) {
            let row = colors[channel.place.component];
            with_any_lane!(main, |l| {
                simd.run(
                    #[inline(always)]
                    || pack(l, row, channel, &mut texels),
                )
            });
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

#[inline(always)]
fn pack<L: Lane>(lane: &L, row: &LaneRow, channel: &PackedChannel, texels: &mut LaneRow) {
    match channel.coding {
        Coding::Steps(scale, half) => {
            for i in 0..LANES {
                texels[i] |= lane.steps(L::load(row[i]), scale, half) << channel.place.shift;
            }
        }
        Coding::Single => {
            for i in 0..LANES {
                texels[i] |= single(lane, row[i]);
            }
        }
        Coding::Blended => {}
    }
}

/// Encodes a value for a channel.
fn code<L: Lane>(lane: &L, raw: u32, coding: Coding) -> u32 {
    match coding {
        Coding::Steps(scale, half) => lane.steps(L::load(raw), scale, half),
        Coding::Single => single(lane, raw),
        Coding::Blended => 0,
    }
}

#[inline(always)]
fn single<L: Lane>(lane: &L, raw: u32) -> u32 {
    let x = lane.to_f64(L::load(raw)) as f32;
    if x.is_nan() { 0x7fc0_0000 } else { x.to_bits() }
}

/// Clamps a value to [0, 1]; NaN gives 0.
#[inline(always)]
fn clamped(x: f64) -> f64 {
    let low = if x > 0.0 { x } else { 0.0 };
    if low < 1.0 { low } else { 1.0 }
}

/// Encodes values, clamped to [0, 1], as depth patterns.
///
/// In double precision a value with at most 24 significant bits times 2^24 - 1 is exact, and so is adding one half near
/// a rounding boundary. Values with more bits and other depth formats are encoded by [`crate::output`].
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
        FormatKind::Normalized { .. } if bits > 0 => {
            let (scale, half) = (f64::from((1u32 << bits) - 1), if nearest { 0.5 } else { 0.0 });
            return with_any_lane!(lane, |l| {
                simd.run(
                    #[inline(always)]
                    || normalized_to_steps(l, row, scale, half, to),
                )
            });
        }
        FormatKind::Float { .. } if bits > 0 => {
            let (scale, half) = (f64::from((1u32 << bits) - 1), if nearest { 0.5 } else { 0.0 });
            return simd.run(
                #[inline(always)]
                || float_to_steps(row, scale, half, to),
            );
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

/// A fixed-point value `k / 2^F` in [0, 1] equals `k 2^(n-F)` minus `k / 2^F` steps of `1 / (2^n - 1)`; the fraction
/// subtracts one step if it exceeds what rounding restores.
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

#[inline(always)]
fn normalized_to_steps<L: Lane>(lane: &L, row: &LaneRow, scale: f64, half: f64, out: &mut LaneRow) {
    for i in 0..LANES {
        out[i] = lane.steps(L::load(row[i]), scale, half);
    }
}

/// Numbers of every float format are stored as host singles.
#[inline(always)]
fn float_to_steps(row: &LaneRow, scale: f64, half: f64, out: &mut LaneRow) {
    for i in 0..LANES {
        out[i] = (clamped(f64::from(f32::from_bits(row[i]))) * scale + half) as u32;
    }
}

#[inline(always)]
fn float_to_single(row: &LaneRow, out: &mut LaneRow) {
    for i in 0..LANES {
        let x = f32::from_bits(row[i]);
        let low = if x > 0.0 { x } else { 0.0 };
        out[i] = if low < 1.0 { low } else { 1.0f32 }.to_bits();
    }
}
