//! From shaded lanes to targets: tests in rows, then the fragments that pass one by one through the output room.

use super::arith::Formats;
use super::graph::Arith;
use super::lane::{LANES, Lane};
use super::lanes::{AnyLane, with_any_lane};
use super::slots::{Row, Slot, Slots, TRUE};
use crate::event::FragmentCounts;
use crate::num::{Format, Kind, ops};
use crate::output::{
    AlphaTest, CompareFunction, DepthFormat, DepthState, FragmentFate, FragmentOutput, OutputRules, OutputState,
    TargetTile, merge,
};
use crate::texture::TargetRounding;

/// Where the results of a program lie.
#[derive(Clone, Debug, Default)]
pub(crate) struct Results {
    /// The components of the colours.
    pub(crate) colors: [Option<[Slot; 4]>; 4],
    /// Mask of killed lanes.
    pub(crate) killed: Option<Slot>,
    /// Depth of the program's own, its format, and the mask of lanes that have one, if not all do.
    pub(crate) depth: Option<(Arith, Slot, Option<Slot>)>,
}

/// The output stage of a draw.
#[derive(Clone, Debug)]
pub(crate) struct Output {
    pub(crate) state: OutputState,
    pub(crate) rules: OutputRules,
    /// Bit `i`: the program writes colour `i`.
    pub(crate) written: u8,
}

impl Output {
    /// Takes the covered lanes through the output stage.
    pub(crate) fn run(
        &self,
        (results, formats, slots): (&Results, &Formats, &Slots),
        (covered, depth): (&Row, &Row),
        origin: (u32, u32),
        tile: &mut TargetTile,
        counts: &mut FragmentCounts,
    ) {
        let mut alive = *covered;
        if let Some(killed) = results.killed {
            counts.killed += drop_lanes(&mut alive, |i| slots.row(killed)[i] == 0);
        }
        if let Some(test) = &self.state.alpha {
            let mut passes = [0; LANES];
            self.alpha(test, results, formats, slots, &mut passes);
            counts.alpha_failed += drop_lanes(&mut alive, |i| passes[i] != 0);
        }
        if let (Some(function), true) = (self.state.depth.test, tile.depth.is_some()) {
            let mut new = [0; LANES];
            self.quantised(results, formats, slots, depth, &alive, tile, &mut new);
            counts.depth_failed += self.depth_test(function, &new, &mut alive, origin, tile);
        }
        // What is left is blended and written by the reference; its tests are switched off.
        let state = OutputState { alpha: None, depth: DepthState { test: None, write: false }, ..self.state };
        let main = formats.lane(Arith::Main);
        for lane in (0..LANES).filter(|&l| alive[l] != 0) {
            let colors = results.colors.map(|c| c.map_or([0; 4], |c| c.map(|s| main.encode(slots.row(s)[lane]))));
            let fragment = FragmentOutput { colors, written: self.written, depth: None, killed: false };
            let (x, y) = super::raster::place(lane);
            if merge(tile, (origin.0 + x, origin.1 + y), &fragment, 0, &state, &self.rules) == FragmentFate::Passed {
                counts.passed += 1;
            }
        }
    }

    fn alpha(&self, test: &AlphaTest, results: &Results, formats: &Formats, slots: &Slots, passes: &mut Row) {
        let main = formats.lane(Arith::Main);
        let reference = main.decode(ops::convert(&Format::FP32, formats.format(Arith::Main), test.reference).bits);
        let zero = [0; LANES];
        let alpha = results.colors[0].map_or(&zero, |c| slots.row(c[3]));
        with_any_lane!(main, |lane| { compare(lane, alpha, reference, test.function, passes) });
    }

    /// Depths as the depth buffer stores them, for the lanes still alive.
    #[expect(clippy::too_many_arguments, reason = "rows in, rows out")]
    fn quantised(
        &self,
        results: &Results,
        formats: &Formats,
        slots: &Slots,
        depth: &Row,
        alive: &Row,
        tile: &TargetTile,
        out: &mut Row,
    ) {
        let Some(buffer) = &tile.depth else { return };
        let rounding = self.rules.depth_rounding;
        let single = formats.lane(Arith::Single);
        match results.depth {
            Some((arith, own, None)) => {
                let lane = formats.lane(arith);
                quantise(lane, formats.format(arith), buffer.format, rounding, slots.row(own), alive, out);
            }
            Some((arith, own, Some(decided))) => {
                let decided = slots.row(decided);
                for i in (0..LANES).filter(|&i| alive[i] != 0) {
                    let (format, bits) = if decided[i] != 0 {
                        (formats.format(arith), formats.lane(arith).encode(slots.row(own)[i]))
                    } else {
                        (Format::FP32, single.encode(depth[i]))
                    };
                    out[i] = buffer.format.quantise(format, bits, rounding);
                }
            }
            None => quantise(single, Format::FP32, buffer.format, rounding, depth, alive, out),
        }
    }

    fn depth_test(
        &self,
        function: CompareFunction,
        new: &Row,
        alive: &mut Row,
        origin: (u32, u32),
        tile: &mut TargetTile,
    ) -> u64 {
        let region = tile.region;
        let Some(buffer) = &mut tile.depth else { return 0 };
        let mut failed = 0;
        for y in 0..region.height.min(16) {
            let start = (y * region.width) as usize;
            let Some(row) = buffer.data.get_mut(start..start + region.width as usize) else { continue };
            let first = ((region.y - origin.1 + y) * 16 + region.x - origin.0) as usize;
            for (k, old) in row.iter_mut().enumerate() {
                let i = first + k;
                if alive[i] == 0 {
                    continue;
                }
                if !function.holds(Some(new[i].cmp(old))) {
                    alive[i] = 0;
                    failed += 1;
                } else if self.state.depth.write {
                    *old = new[i];
                }
            }
        }
        failed
    }
}

/// Drops the lanes for which `stays` doesn't hold and counts them.
fn drop_lanes(alive: &mut Row, stays: impl Fn(usize) -> bool) -> u64 {
    let mut dropped = 0;
    for (i, lane) in alive.iter_mut().enumerate() {
        let goes = (*lane != 0) & !stays(i);
        dropped += u64::from(goes);
        *lane = if goes { 0 } else { *lane };
    }
    dropped
}

/// Mask of the lanes whose value compares so with the reference; a NaN is equal to nothing.
fn compare<L: Lane>(lane: &L, row: &Row, reference: u32, function: CompareFunction, out: &mut Row) {
    let r = L::load(reference);
    for i in 0..LANES {
        let a = L::load(row[i]);
        let (below, equal, above) = (lane.lt(a, r), lane.eq(a, r), lane.lt(r, a));
        let holds = match function {
            CompareFunction::Never => false,
            CompareFunction::Less => below,
            CompareFunction::Equal => equal,
            CompareFunction::LessEqual => below | equal,
            CompareFunction::Greater => above,
            CompareFunction::NotEqual => !equal,
            CompareFunction::GreaterEqual => above | equal,
            CompareFunction::Always => true,
        };
        out[i] = if holds { TRUE } else { 0 };
    }
}

/// Values clamped to [0, 1] as depth patterns.
///
/// In doubles: a value of at most 24 significant bits times 2^24 - 1 is exact, and so is adding the half where that
/// decides anything. Wider values and the other depth formats go through the output room.
fn quantise(
    lane: &AnyLane,
    format: Format,
    depth: DepthFormat,
    rounding: TargetRounding,
    row: &Row,
    alive: &Row,
    out: &mut Row,
) {
    let narrow = match format.kind {
        Kind::Fixed { .. } => format.width() <= 24,
        Kind::Float { .. } => true,
    };
    let steps = match depth {
        DepthFormat::Unorm16 => 65_535.0,
        DepthFormat::Unorm24 => 16_777_215.0,
        DepthFormat::Float32 if narrow => return with_any_lane!(lane, |lane| { to_single(lane, row, out) }),
        _ => 0.0,
    };
    if narrow && steps > 0.0 {
        let half = if rounding == TargetRounding::Nearest { 0.5 } else { 0.0 };
        return with_any_lane!(lane, |lane| { to_steps(lane, row, steps, half, out) });
    }
    for i in (0..LANES).filter(|&i| alive[i] != 0) {
        out[i] = depth.quantise(format, lane.encode(row[i]), rounding);
    }
}

/// A value clamped to [0, 1]; NaN gives 0.
fn clamped(x: f64) -> f64 {
    let low = if x > 0.0 { x } else { 0.0 };
    if low < 1.0 { low } else { 1.0 }
}

fn to_steps<L: Lane>(lane: &L, row: &Row, steps: f64, half: f64, out: &mut Row) {
    for i in 0..LANES {
        out[i] = (clamped(lane.to_f64(L::load(row[i]))) * steps + half) as u32;
    }
}

fn to_single<L: Lane>(lane: &L, row: &Row, out: &mut Row) {
    for i in 0..LANES {
        out[i] = (clamped(lane.to_f64(L::load(row[i]))) as f32).to_bits();
    }
}
