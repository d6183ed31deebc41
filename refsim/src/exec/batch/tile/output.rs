//! Output stage in rows: kill, alpha test, depth test, texels. Unsupported cases (some blending, signed or small float
//! channels) are processed by [`crate::output`], fragment by fragment.

use refsim_lanes::{LANES, LaneRow, Reading, SimdLevel, Slots};

use super::packed::PackedLanes;
use super::store::{Survivors, quantise, write_lane, write_rows};
use super::targets::Targets;
use crate::event::FragmentCounts;
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::schedule::ResultSlots;
use crate::exec::lower::{Arith, Slot, TRUE};
use crate::num::{Format, ops};
use crate::output::{
    AlphaTest, CompareFunction, DepthFormat, DepthState, FragmentOutput, MAX_TARGETS, OutputRules, OutputState, merge,
};

/// Results of a program in the lanes of a tile.
#[derive(Clone, Copy)]
pub(crate) struct Shaded<'a> {
    pub(crate) results: &'a ResultSlots,
    pub(crate) formats: &'a LaneFormats,
    pub(crate) slots: &'a Slots,
    pub(crate) covered: &'a LaneRow,
    pub(crate) depth: &'a LaneRow,
    /// The pixels of the lanes, if fragments are packed.
    pub(crate) packed: Option<&'a PackedLanes>,
    /// `true` if the depth test was made before the program ran.
    pub(crate) tested: bool,
}

/// A fragment that passed the tests before the depth test.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fragment {
    lane: u8,
    /// Depth, as stored in the depth buffer.
    depth: u32,
    colors: [[u32; 4]; MAX_TARGETS],
}

impl Shaded<'_> {
    fn fragment(&self, lane: usize, depth: u32) -> Fragment {
        let value = |slot: Slot| self.slots.row(slot)[lane];
        Fragment { lane: lane as u8, depth, colors: self.results.colors.map(|c| c.map_or([0; 4], |c| c.map(value))) }
    }

    /// The surviving packed fragments, in order of submission.
    fn packed(self, packed: &PackedLanes, survivors: &Survivors) -> impl Iterator<Item = Fragment> {
        let alive = packed.fragments().filter(|(lane, _)| survivors.alive[*lane] != 0);
        alive.map(move |(lane, at)| Fragment { lane: at.tile_lane, ..self.fragment(lane, survivors.depth[lane]) })
    }

    pub(crate) fn gather(&self, survivors: &Survivors, out: &mut Vec<Fragment>) {
        match self.packed {
            _ if survivors.count == 0 => {}
            Some(packed) => out.extend(self.packed(packed, survivors)),
            None => {
                let alive = (0..LANES).filter(|&lane| survivors.alive[lane] != 0);
                out.extend(alive.map(|lane| self.fragment(lane, survivors.depth[lane])));
            }
        }
    }
}

#[derive(Clone, Debug)]
pub(crate) struct OutputStage {
    pub(crate) state: OutputState,
    pub(crate) rules: OutputRules,
    /// Bit `i` is set if the program writes colour `i`.
    pub(crate) written: u8,
}

impl OutputStage {
    /// Applies kill and alpha test, and converts depths for the depth test.
    pub(crate) fn test(
        &self,
        shaded: Shaded<'_>,
        depth: Option<DepthFormat>,
        out: &mut Survivors,
        counts: &mut FragmentCounts,
    ) {
        let simd = shaded.formats.simd();
        out.alive = *shaded.covered;
        out.count = simd.run(
            #[inline(always)]
            || population(&out.alive),
        );
        if let Some(killed) = shaded.results.killed {
            let killed = shaded.slots.row(killed);
            let left = simd.run(
                #[inline(always)]
                || and_not(&mut out.alive, killed),
            );
            counts.killed += out.keep(left);
        }
        if let Some(test) = self.state.alpha.as_ref().filter(|_| out.count > 0) {
            let left = alpha(test, &shaded, &mut out.alive);
            counts.alpha_failed += out.keep(left);
        }
        if let (Some(_), Some(format), true) = (self.state.depth.test, depth, out.count > 0) {
            self.quantised(&shaded, format, out);
        }
    }

    /// Recounts the surviving lanes; returns the number removed.
    pub(super) fn recount(&self, simd: SimdLevel, out: &mut Survivors) -> u64 {
        let left = simd.run(
            #[inline(always)]
            || population(&out.alive),
        );
        out.keep(left)
    }

    /// Depth test, blending and writing of the surviving lanes.
    pub(crate) fn merge(
        &self,
        shaded: Shaded<'_>,
        survivors: &mut Survivors,
        targets: &mut Targets<'_>,
        counts: &mut FragmentCounts,
    ) {
        if survivors.count == 0 {
            return;
        }
        if let Some(packed) = shaded.packed {
            for fragment in shaded.packed(packed, survivors) {
                self.merge_one(&fragment, shaded.tested, shaded.formats, targets, counts);
            }
            return;
        }
        let simd = shaded.formats.simd();
        if let (Some(function), Some(stored), false) = (self.state.depth.test, &mut targets.depth, shaded.tested) {
            let (new, alive) = (&survivors.depth, &mut survivors.alive);
            simd.run(
                #[inline(always)]
                || depth_test(function, self.state.depth.write, new, alive, stored),
            );
            counts.depth_failed += self.recount(simd, survivors);
        }
        counts.passed += u64::from(survivors.count);
        if survivors.count == 0 {
            return;
        }
        for i in 0..MAX_TARGETS {
            let Some(rows) = &mut targets.colors[i] else { continue };
            let Some(colors) = shaded.results.colors[i] else { continue };
            let colors = colors.map(|slot| shaded.slots.row(slot));
            write_rows(rows, colors, survivors, shaded.formats);
        }
        self.merge_rest(shaded, survivors, targets);
    }

    /// Writes the targets that are not kept in rows, through [`crate::output`].
    fn merge_rest(&self, shaded: Shaded<'_>, survivors: &Survivors, targets: &mut Targets<'_>) {
        let written = self.written_elsewhere(targets);
        if written == 0 {
            return;
        }
        for lane in (0..LANES).filter(|&l| survivors.alive[l] != 0) {
            self.merge_elsewhere(written, &shaded.fragment(lane, 0), shaded.formats, targets);
        }
    }

    /// Bits of the written colours whose targets are not kept in rows.
    fn written_elsewhere(&self, targets: &Targets<'_>) -> u8 {
        let here = (0..MAX_TARGETS).filter(|&i| targets.colors[i].is_none() && targets.tile.colors[i].is_some());
        here.fold(0, |bits, i| bits | (self.written & 1 << i))
    }

    /// Writes a fragment through [`crate::output`], with tests disabled.
    fn merge_elsewhere(&self, written: u8, fragment: &Fragment, formats: &LaneFormats, targets: &mut Targets<'_>) {
        let state = OutputState { alpha: None, depth: DepthState { test: None, write: false }, ..self.state };
        let main = formats.lane(Arith::Main);
        let colors = fragment.colors.map(|c| c.map(|raw| main.encode(raw)));
        let output = FragmentOutput { colors, written, depth: None, killed: false };
        merge(targets.tile, targets.frame.pixel(fragment.lane.into()), &output, 0, &state, &self.rules);
    }

    /// [`Self::merge`] for one fragment, without the depth test if `tested`.
    pub(crate) fn merge_one(
        &self,
        fragment: &Fragment,
        tested: bool,
        formats: &LaneFormats,
        targets: &mut Targets<'_>,
        counts: &mut FragmentCounts,
    ) {
        let lane = usize::from(fragment.lane);
        if let (Some(function), Some(stored), false) = (self.state.depth.test, &mut targets.depth, tested) {
            if !function.holds(Some(fragment.depth.cmp(&stored[lane]))) {
                counts.depth_failed += 1;
                return;
            }
            if self.state.depth.write {
                stored[lane] = fragment.depth;
            }
        }
        counts.passed += 1;
        for (rows, colors) in targets.colors.iter_mut().zip(&fragment.colors) {
            if let Some(rows) = rows {
                write_lane(rows, colors, lane, formats);
            }
        }
        let written = self.written_elsewhere(targets);
        if written != 0 {
            self.merge_elsewhere(written, fragment, formats, targets);
        }
    }

    /// Converts depths of surviving lanes to the depth buffer's format.
    fn quantised(&self, shaded: &Shaded<'_>, buffer: DepthFormat, out: &mut Survivors) {
        let (formats, slots, rounding) = (shaded.formats, shaded.slots, self.rules.depth_rounding);
        let single = formats.lane(Arith::Single);
        match shaded.results.depth {
            Some((arith, own, None)) => quantise((formats, arith), buffer, rounding, slots.row(own), out),
            Some((arith, own, Some(decided))) => {
                let decided = slots.row(decided);
                for i in (0..LANES).filter(|&i| out.alive[i] != 0) {
                    let (format, bits) = if decided[i] != 0 {
                        (formats.format(arith), formats.lane(arith).encode(slots.row(own)[i]))
                    } else {
                        (Format::FP32, single.encode(shaded.depth[i]))
                    };
                    out.depth[i] = buffer.quantise(format, bits, rounding);
                }
            }
            None => quantise((formats, Arith::Single), buffer, rounding, shaded.depth, out),
        }
    }
}

/// Number of lanes in a mask.
#[inline(always)]
pub(super) fn population(row: &LaneRow) -> u32 {
    row.iter().map(|&m| m & 1).sum()
}

/// Removes the lanes of a mask from `alive`; returns the number left.
#[inline(always)]
fn and_not(alive: &mut LaneRow, mask: &LaneRow) -> u32 {
    let mut left = 0;
    for i in 0..LANES {
        alive[i] &= !mask[i];
        left += alive[i] & 1;
    }
    left
}

/// Removes lanes that fail the alpha test from `alive`; returns the number left.
fn alpha(test: &AlphaTest, shaded: &Shaded<'_>, alive: &mut LaneRow) -> u32 {
    let formats = shaded.formats;
    let main = formats.lane(Arith::Main);
    let reference = main.decode(ops::convert(&Format::FP32, formats.format(Arith::Main), test.reference).bits);
    let zero = [0; LANES];
    let alpha = shaded.results.colors[0].map_or(&zero, |c| shaded.slots.row(c[3]));
    let reading = main.reading();
    formats.simd().run(
        #[inline(always)]
        || match reading {
            Reading::Word => {
                let number = |raw| reading.to_f64(raw);
                compare(number, alpha, reference, test.function, alive)
            }
            Reading::Float => compare(f32::from_bits, alpha, reference, test.function, alive),
            Reading::Integer { .. } => compare(u32::cast_signed, alpha, reference, test.function, alive),
        },
    )
}

/// Removes lanes whose value fails a comparison with the reference from `alive`; returns the number left. With NaN only
/// "not equal" and "always" hold.
#[inline(always)]
fn compare<T: PartialOrd>(
    number: impl Fn(u32) -> T,
    row: &LaneRow,
    reference: u32,
    function: CompareFunction,
    alive: &mut LaneRow,
) -> u32 {
    let r = number(reference);
    let [less, equal, greater] = function.orders();
    let mut left = 0;
    for i in 0..LANES {
        let value = number(row[i]);
        let [below, same, above] = [value < r, value == r, value > r];
        let unordered = !(below | same | above) & less & greater;
        let holds = below & less | same & equal | above & greater | unordered;
        alive[i] &= if holds { TRUE } else { 0 };
        left += alive[i] & 1;
    }
    left
}

/// Removes failing lanes from `alive`; if `write`, stores the depths of the other lanes.
#[inline(always)]
pub(super) fn depth_test(
    function: CompareFunction,
    write: bool,
    new: &LaneRow,
    alive: &mut LaneRow,
    stored: &mut LaneRow,
) {
    let [less, equal, greater] = function.orders();
    for i in 0..LANES {
        let (new, old) = (new[i], stored[i]);
        let holds = (new < old) & less | (new == old) & equal | (new > old) & greater;
        alive[i] &= if holds { TRUE } else { 0 };
    }
    if write {
        super::raster::lay_over(stored, new, alive);
    }
}
