//! Filtered reads in rows that depend on the level of detail: each level that some lane needs is read for all lanes,
//! and each lane selects its level.
//!
//! Most tiles need one level or two adjacent levels. Values stay unrounded until levels are combined: exact sums for
//! fixed point, bytes where the device interpolates them, singles for floats.

use refsim_lanes::{AnyLane, LANES, LaneRow, SimdLevel, Slots};

use super::component::FilteredComponent;
use super::corners::byte_between;
use super::detail::{LevelChoice, PickedLevels};
use super::filter::{FilteredLevel, FilteredRows, TexelSource};
use crate::exec::SamplerBinding;
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::schedule::FetchStep;
use crate::texture::{Image, MipFilter, SampleRules, TextureKind};

/// Maximum total fraction bits of weights, along all axes and between levels, for which sums are exact: numerators have
/// 16 bits and a sign, their differences one bit more, and doubles 53 bits.
const EXACT_BITS: usize = 35;

#[derive(Debug)]
pub(crate) struct LeveledTexture {
    choice: LevelChoice,
    levels: Vec<FilteredLevel>,
}

impl LeveledTexture {
    /// Prepares a binding; `None` for cube maps, and for weights with too many bits.
    pub(crate) fn new(binding: &SamplerBinding<'_>, rules: &SampleRules, lane: &AnyLane) -> Option<Self> {
        let SamplerBinding { image, state } = binding;
        let choice = LevelChoice::new(image, state, rules)?;
        let axes = if image.kind() == TextureKind::Volume { 3 } else { 2 };
        let bits = axes * usize::from(rules.filter_fraction_bits.min(12)) + usize::from(choice.bits());
        if state.mip == MipFilter::Linear && bits > EXACT_BITS {
            return None;
        }
        let level = |number| FilteredLevel::of_level(binding, number, rules, lane);
        Some(Self { choice, levels: (0..image.levels().len()).map(level).collect() })
    }

    /// Reads texels into the slots of the step; from a large level only for enabled lanes.
    pub(crate) fn read(
        &self,
        (image, rules): (&Image, &SampleRules),
        step: &FetchStep,
        formats: &LaneFormats,
        (run, slots): (&LaneRow, &mut Slots),
    ) {
        let simd = formats.simd();
        let picked = self.choice.pick(step, slots, simd);
        let source = TexelSource { image, rules, run };
        let mut rows = [[0.0; LANES]; 4];
        let sets = LevelSets::of(&picked, run);
        for (level, smaller) in sets.keys(sets.first) {
            let filter = self.choice.filter(smaller);
            // All lanes use the same level and filter, so the row can be written in place.
            if sets.first.count_ones() == 1 {
                self.levels[level].add_up(filter, source, step, (slots, simd), &mut rows);
                continue;
            }
            let mut found = [[0.0; LANES]; 4];
            self.levels[level].add_up(filter, source, step, (slots, simd), &mut found);
            let wanted = |i: usize| key(&picked, i) == (level, smaller);
            take(step, wanted, &found, &mut rows);
        }
        if sets.second != 0 {
            self.combine(&picked, sets.second, (source, step), (slots, simd), &mut rows);
        }
        self.levels[0].round(&rows, step, (rules, formats), slots);
    }

    /// For lanes that read a second level, adds the weighted difference between the levels to the first level's
    /// results.
    fn combine(
        &self,
        picked: &PickedLevels,
        seconds: u64,
        (source, step): (TexelSource<'_>, &FetchStep),
        (slots, simd): (&Slots, SimdLevel),
        rows: &mut FilteredRows,
    ) {
        let mut second = [[0.0; LANES]; 4];
        for (level, smaller) in LevelSets::keys_of(seconds) {
            let mut found = [[0.0; LANES]; 4];
            let next = (level + 1).min(self.levels.len() - 1);
            self.levels[next].add_up(self.choice.filter(smaller), source, step, (slots, simd), &mut found);
            take(step, |i| key(picked, i) == (level, smaller), &found, &mut second);
        }
        let share = 1.0 / f64::from(1u32 << self.choice.bits());
        for c in (0..4).filter(|&c| step.to[c].is_some()) {
            let (first, second) = (&mut rows[c], &second[c]);
            match self.levels[0].component(c) {
                FilteredComponent::Constant(_) => {}
                FilteredComponent::Ratio(..) => simd.run(
                    #[inline(always)]
                    || {
                        for i in 0..LANES {
                            let weight = f64::from(picked.weight[i]) * share;
                            let between = first[i] + weight * (second[i] - first[i]);
                            first[i] = if picked.weight[i] == 0 { first[i] } else { between };
                        }
                    },
                ),
                FilteredComponent::Byte(..) => simd.run(
                    #[inline(always)]
                    || {
                        for i in 0..LANES {
                            let (a, b, weight) = (first[i] as i32, second[i] as i32, picked.weight[i].cast_signed());
                            first[i] = f64::from(byte_between(a, b, weight, self.choice.bits()));
                        }
                    },
                ),
                FilteredComponent::Single(_) => simd.run(
                    #[inline(always)]
                    || {
                        for i in 0..LANES {
                            let (a, b) = (first[i] as f32, second[i] as f32);
                            let between = a + picked.weight[i] as f32 * share as f32 * (b - a);
                            first[i] = if picked.weight[i] == 0 { first[i] } else { f64::from(between) };
                        }
                    },
                ),
            }
        }
    }
}

/// First level of a lane, and `true` for the minification filter.
#[inline(always)]
fn key(picked: &PickedLevels, lane: usize) -> (usize, bool) {
    (picked.first[lane] as usize, picked.smaller[lane] != 0)
}

/// Sets of the keys that occur, as bits `2 level + filter`. A texture has at most 32 levels.
struct LevelSets {
    first: u64,
    /// Keys of the lanes that also read the next level.
    second: u64,
}

impl LevelSets {
    fn of(picked: &PickedLevels, run: &LaneRow) -> Self {
        let mut sets = Self { first: 0, second: 0 };
        for i in (0..LANES).filter(|&i| run[i] != 0) {
            let bit = 1 << (2 * picked.first[i] + picked.smaller[i]);
            sets.first |= bit;
            sets.second |= if picked.weight[i] == 0 { 0 } else { bit };
        }
        sets
    }

    fn keys(&self, set: u64) -> impl Iterator<Item = (usize, bool)> + use<> {
        Self::keys_of(set)
    }

    fn keys_of(set: u64) -> impl Iterator<Item = (usize, bool)> + use<> {
        (0..64).filter(move |bit| set >> bit & 1 == 1).map(|bit| (bit / 2, bit % 2 == 1))
    }
}

/// Copies the components of a step, for the lanes selected by `wanted`.
fn take(step: &FetchStep, wanted: impl Fn(usize) -> bool, from: &FilteredRows, to: &mut FilteredRows) {
    for c in (0..4).filter(|&c| step.to[c].is_some()) {
        for i in (0..LANES).filter(|&i| wanted(i)) {
            to[c][i] = from[c][i];
        }
    }
}
