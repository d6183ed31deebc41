//! Texture reads of a batch: in whole rows where that is exact, else lane by lane by [`crate::texture`] (level of
//! detail on cube maps, three axes with the finest weights).

use std::sync::Arc;

use refsim_lanes::{AnyLane, LANES, LaneRow, Slots};

use super::filter::FilteredLevel;
use super::leveled::LeveledTexture;
use crate::exec::SamplerBinding;
use crate::exec::batch::cache::Cache;
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::schedule::{FetchDetail, FetchStep};
use crate::exec::lower::Arith;
use crate::num::{Format, ops};
use crate::texture::{Lod, SampleRules, SamplerState, lod_from_derivatives, sample};

/// A bound texture, prepared for reads by batches.
#[derive(Debug)]
pub(crate) struct BatchTexture<'a> {
    binding: SamplerBinding<'a>,
    rules: SampleRules,
    table: Option<Arc<TextureTable>>,
}

/// Key of a table: version stamp of the texture's contents, sampler state, sampling rules.
pub(crate) type TableKey = (u64, SamplerState, SampleRules);

/// Cache of tables, for textures whose contents have a stamp.
pub(crate) type TextureTables = Cache<TableKey, TextureTable>;

/// Data of a texture that is read in rows.
#[derive(Debug)]
pub(crate) enum TextureTable {
    Filtered(FilteredLevel),
    Leveled(LeveledTexture),
}

impl TextureTable {
    /// Prepares a binding; `None` if it must be read lane by lane.
    fn new(binding: &SamplerBinding<'_>, rules: &SampleRules, lane: &AnyLane) -> Option<Self> {
        match binding.needs_detail() {
            true => LeveledTexture::new(binding, rules, lane).map(Self::Leveled),
            false => Some(Self::Filtered(FilteredLevel::new(binding, rules, lane))),
        }
    }

    /// Returns `true` if the table is small enough to be cached.
    fn is_small(&self) -> bool {
        match self {
            Self::Filtered(level) => !level.is_large(),
            // A leveled texture contains only tables of small levels, built on first use.
            Self::Leveled(_) => true,
        }
    }
}

impl<'a> BatchTexture<'a> {
    pub(crate) fn new(binding: SamplerBinding<'a>, rules: SampleRules, lane: &AnyLane, tables: &TextureTables) -> Self {
        let key = binding.image.contents_name().map(|name| (name, binding.state, rules));
        let known = key.and_then(|key| tables.find(|known| *known == key));
        let table = known.or_else(|| {
            let made = TextureTable::new(&binding, &rules, lane)?;
            Some(match key {
                Some(key) if made.is_small() => tables.get(|known| *known == key, || (key, made)),
                _ => Arc::new(made),
            })
        });
        Self { binding, rules, table }
    }

    /// Reads texels into the slots of the step, for the lanes enabled in `run`.
    pub(crate) fn read(&self, step: &FetchStep, formats: &LaneFormats, run: &LaneRow, slots: &mut Slots) {
        match self.table.as_deref() {
            Some(TextureTable::Filtered(level)) => {
                level.read((self.binding.image, &self.binding.state), &self.rules, step, formats, (run, slots));
            }
            Some(TextureTable::Leveled(levels)) => {
                levels.read((self.binding.image, &self.rules), step, formats, (run, slots));
            }
            None => self.read_lanes(step, formats, run, slots),
        }
    }

    fn read_lanes(&self, step: &FetchStep, formats: &LaneFormats, run: &LaneRow, slots: &mut Slots) {
        let single = formats.lane(Arith::Single);
        // Disabled lanes still take part in arithmetic, so they get a number of the format in place of the slot's old
        // contents.
        for to in step.to.iter().flatten() {
            slots.fill(*to, 0);
        }
        let vector = |slots: &Slots, from: &[u16; 4], lane: usize| from.map(|s| single.encode(slots.row(s)[lane]));
        for lane in (0..LANES).filter(|&l| run[l] != 0) {
            let at = |l: usize| vector(slots, &step.coordinates, l);
            let coordinates = at(lane);
            let lod = if self.binding.needs_detail() {
                let across = |bit: usize| {
                    let (low, high) = (at(lane & !bit), at(lane | bit));
                    std::array::from_fn(|i| ops::sub(Format::FP32, high[i], low[i]).bits)
                };
                let (ddx, ddy) = match &step.detail {
                    FetchDetail::Gradients(x, y) => (vector(slots, x, lane), vector(slots, y, lane)),
                    _ => (across(1), across(16)),
                };
                let level =
                    lod_from_derivatives(self.binding.image, coordinates, ddx, ddy, self.rules.lod_fraction_bits);
                Lod::Level(match step.detail {
                    FetchDetail::Biased(bias) => {
                        ops::add(Format::FP32, level, single.encode(slots.row(bias)[lane])).bits
                    }
                    _ => level,
                })
            } else {
                Lod::Base
            };
            let bits = sample(Some(self.binding.image), &self.binding.state, &self.rules, coordinates, lod);
            let main = formats.lane(Arith::Main);
            for (to, bits) in step.to.iter().zip(bits) {
                if let Some(to) = *to {
                    slots.row_mut(to)[lane] = main.decode(bits);
                }
            }
        }
    }
}
