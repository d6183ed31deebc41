//! Targets of one tile as rows in lane order: depth patterns, and texels of colour targets in 32-bit words. They stay
//! in the L1 cache while all triangles of the tile are drawn, and are copied back once.

use refsim_lanes::{LANES, LaneRow};

use super::blend::{Blender, ChannelPlace};
use super::raster::TileFrame;
use crate::output::{ColorTile, MAX_TARGETS, OutputRules, OutputState, TargetTile, WriteMask};
use crate::texture::{ChannelClass, Region, TargetRounding, TexelFormat};

/// Encoding of a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Coding {
    /// `floor(x * a + b)` with `x` clamped to [0, 1]: exact in doubles if `x` and `a` have at most 24 bits.
    Steps(f64, f64),
    /// A single.
    Single,
    /// Encoded by the blender.
    Blended,
}

/// A stored channel that is written, and its encoding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PackedChannel {
    pub(crate) place: ChannelPlace,
    pub(crate) coding: Coding,
}

/// Encoding of colours as texels of one target.
#[derive(Clone, Debug)]
pub(crate) struct Packing {
    pub(crate) channels: Vec<PackedChannel>,
    /// Bits that are written, by word.
    pub(crate) written: Vec<u32>,
    pub(crate) blender: Option<Blender>,
}

impl Packing {
    /// Creates the encoding; `None` if only [`crate::output`] can encode: signed channels, small floats without
    /// blending, and unsupported blending.
    pub(crate) fn new(
        format: TexelFormat,
        mask: WriteMask,
        state: &OutputState,
        rounding: TargetRounding,
    ) -> Option<Self> {
        let blender = match &state.blend {
            Some(blend) => Some(Blender::new(format, blend, rounding)?),
            None => None,
        };
        let mut packing = Self { channels: Vec::new(), written: vec![0; format.bytes().div_ceil(4)], blender };
        for channel in format.record().stored() {
            let (word, shift) = (usize::from(channel.shift / 32), u32::from(channel.shift % 32));
            let coding = match channel.class {
                _ if packing.blender.is_some() => Coding::Blended,
                ChannelClass::Unorm if channel.bits <= 24 && shift + u32::from(channel.bits) <= 32 => {
                    let half = if rounding == TargetRounding::Nearest { 0.5 } else { 0.0 };
                    Coding::Steps(f64::from((1u32 << channel.bits) - 1), half)
                }
                ChannelClass::Float(crate::num::Format::FP32) if shift == 0 => Coding::Single,
                _ => return None,
            };
            if mask.has(channel.stored_from) {
                packing.written[word] |= (u32::MAX >> (32 - channel.bits)) << shift;
                let place = ChannelPlace { word, shift, component: channel.stored_from.into() };
                packing.channels.push(PackedChannel { place, coding });
            }
        }
        Some(packing)
    }

    pub(crate) fn words(&self) -> usize {
        self.written.len()
    }
}

/// A colour target in rows.
#[derive(Debug)]
pub(crate) struct ColorRows {
    pub(crate) packing: Packing,
    pub(crate) words: Vec<LaneRow>,
}

#[derive(Debug)]
pub(crate) struct Targets<'t> {
    pub(crate) tile: &'t mut TargetTile,
    pub(crate) frame: TileFrame,
    pub(crate) depth: Option<Box<LaneRow>>,
    /// Targets that are written in rows; other targets are written in the tile.
    pub(crate) colors: [Option<ColorRows>; MAX_TARGETS],
}

impl<'t> Targets<'t> {
    /// Loads a tile into rows. Bit `i` of `written`: the program writes colour `i`.
    pub(crate) fn load(tile: &'t mut TargetTile, written: u8, state: &OutputState, rules: &OutputRules) -> Self {
        let (region, frame) = (tile.region, TileFrame::around(tile.region));
        let depth = tile.depth.as_ref().map(|buffer| {
            let mut row = Box::new([0; LANES]);
            for (lane, index) in lanes(region) {
                row[lane] = buffer.data.get(index).copied().unwrap_or_default();
            }
            row
        });
        let rows = |i: usize| {
            let target = tile.colors[i].as_ref().filter(|_| written >> i & 1 == 1)?;
            let packing = Packing::new(target.format, state.masks[i], state, rules.target_rounding)?;
            Some(ColorRows { words: load_words(target, region, packing.words()), packing })
        };
        let colors = [rows(0), rows(1), rows(2), rows(3)];
        Self { tile, frame, depth, colors }
    }

    pub(crate) fn store(self) {
        let region = self.tile.region;
        if let (Some(row), Some(buffer)) = (&self.depth, &mut self.tile.depth) {
            for (lane, index) in lanes(region) {
                if let Some(slot) = buffer.data.get_mut(index) {
                    *slot = row[lane];
                }
            }
        }
        for (rows, target) in self.colors.iter().zip(&mut self.tile.colors) {
            if let (Some(rows), Some(target)) = (rows, target) {
                store_words(target, region, &rows.words);
            }
        }
    }
}

/// Lanes of a tile's region with the indices of their pixels, in order.
fn lanes(region: Region) -> impl Iterator<Item = (usize, usize)> {
    let frame = TileFrame::around(region);
    let pixels = (region.y..region.y + region.height)
        .flat_map(move |y| (region.x..region.x + region.width).map(move |x| (x, y)));
    pixels.map(move |(x, y)| frame.lane(x, y)).enumerate().map(|(index, lane)| (lane, index))
}

/// Runs of pixels with consecutive lanes, at most 16: first lane, index of the first pixel, length.
fn runs(region: Region) -> impl Iterator<Item = (usize, usize, usize)> {
    let frame = TileFrame::around(region);
    let (width, end) = (region.width as usize, region.x + region.width);
    (0..region.height).flat_map(move |row| {
        let starts = (region.x & !15..end).step_by(16).map(move |x| x.max(region.x));
        starts.map(move |x| {
            let count = ((x & !15) + 16).min(end) - x;
            let index = row as usize * width + (x - region.x) as usize;
            (frame.lane(x, region.y + row), index, count as usize)
        })
    })
}

fn load_words(target: &ColorTile, region: Region, words: usize) -> Vec<LaneRow> {
    let mut rows = vec![[0; LANES]; words];
    let size = target.format.bytes();
    for (lane, index, count) in runs(region) {
        let Some(bytes) = target.bytes.get(index * size..(index + count) * size) else { continue };
        match size {
            4 => load_run::<1>(bytes, lane, &mut rows),
            8 => load_run::<2>(bytes, lane, &mut rows),
            16 => load_run::<4>(bytes, lane, &mut rows),
            _ => {
                for (lane, texel) in (lane..).zip(bytes.chunks_exact(size)) {
                    for (row, bytes) in rows.iter_mut().zip(texel.chunks(4)) {
                        row[lane] = bytes.iter().rev().fold(0, |word, &b| word << 8 | u32::from(b));
                    }
                }
            }
        }
    }
    rows
}

/// Loads texels of `WORDS` whole words.
fn load_run<const WORDS: usize>(bytes: &[u8], lane: usize, rows: &mut [LaneRow]) {
    for (word, row) in rows.iter_mut().enumerate().take(WORDS) {
        for (slot, texel) in row[lane..].iter_mut().zip(bytes.chunks_exact(4 * WORDS)) {
            *slot = texel[4 * word..].first_chunk().map_or(0, |&bytes| u32::from_le_bytes(bytes));
        }
    }
}

fn store_words(target: &mut ColorTile, region: Region, rows: &[LaneRow]) {
    let size = target.format.bytes();
    for (lane, index, count) in runs(region) {
        let Some(bytes) = target.bytes.get_mut(index * size..(index + count) * size) else { continue };
        match size {
            4 => store_run::<1>(bytes, lane, rows),
            8 => store_run::<2>(bytes, lane, rows),
            16 => store_run::<4>(bytes, lane, rows),
            _ => {
                for (lane, texel) in (lane..).zip(bytes.chunks_exact_mut(size)) {
                    for (row, bytes) in rows.iter().zip(texel.chunks_mut(4)) {
                        let count = bytes.len();
                        bytes.copy_from_slice(&row[lane].to_le_bytes()[..count]);
                    }
                }
            }
        }
    }
}

/// Stores texels of `WORDS` whole words.
fn store_run<const WORDS: usize>(bytes: &mut [u8], lane: usize, rows: &[LaneRow]) {
    for (word, row) in rows.iter().enumerate().take(WORDS) {
        for (&value, texel) in row[lane..].iter().zip(bytes.chunks_exact_mut(4 * WORDS)) {
            if let Some(bytes) = texel[4 * word..].first_chunk_mut() {
                *bytes = value.to_le_bytes();
            }
        }
    }
}
