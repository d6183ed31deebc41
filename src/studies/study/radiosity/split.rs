//! Items of parts of a run: rows of form factors, and runs of the sweep.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::room;
use super::sweep::{Sweep, SweepRun};
use super::{Parameters, ProgressFn};
use crate::radiosity::Patches;
use crate::radiosity::form_factor::FormFactorRows;
use crate::split::{Computed, Concatenate, SplitRun};
use crate::study::StudyError;

/// Results of consecutive items. An item is a share of the rows of form factors and of the settings of the sweep.
///
/// Rows come in pairs, the first with the last, the second with the last but one, and so on: a row has the exchanges
/// with later patches alone, so that pairs cost the same.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct RadiosityItems {
    items: usize,
    /// Both rows of each pair; the middle one of an odd number is paired with an empty one.
    pairs: Vec<[Vec<f64>; 2]>,
    /// By setting, then by number of patches.
    pub(super) sweep: Vec<Vec<SweepRun>>,
}

impl Concatenate for RadiosityItems {
    fn are_of(&self, range: &Range<usize>) -> bool {
        self.items == range.len()
    }

    fn append(&mut self, next: Self) {
        self.items += next.items;
        self.pairs.extend(next.pairs);
        self.sweep.extend(next.sweep);
    }
}

/// Computes a part, or takes the results of parts.
pub(super) fn known(
    split: &SplitRun,
    patches: &Patches,
    parameters: &Parameters,
    progress: &mut ProgressFn<'_>,
) -> Result<Computed<Option<RadiosityItems>>, StudyError> {
    let sweep = Sweep::new(parameters)?;
    let (pairs, settings) = (patches.list().len().div_ceil(2), sweep.count());
    let items = pairs.max(settings);
    split.known("shares of rows and settings", items, |range| {
        let share = |count: usize| range.start * count / items.max(1)..range.end * count / items.max(1);
        let sweep = sweep.runs(share(settings), progress)?;
        let pairs = self::pairs(share(pairs), patches, parameters, progress)?;
        Ok(RadiosityItems { items: range.len(), pairs, sweep })
    })
}

/// Both patches of a pair.
fn patches_of(pair: usize, count: usize) -> [usize; 2] {
    [pair, count - 1 - pair]
}

fn pairs(
    range: Range<usize>,
    patches: &Patches,
    parameters: &Parameters,
    progress: &mut ProgressFn<'_>,
) -> Result<Vec<[Vec<f64>; 2]>, StudyError> {
    if range.is_empty() {
        return Ok(Vec::new());
    }
    let count = patches.list().len();
    let is_wanted = |patch: usize| range.contains(&patch.min(count - 1 - patch));
    let rows = room::rows(patches, parameters, &is_wanted, progress)?;
    let of_pair = |pair| {
        let [first, last] = patches_of(pair, count);
        let second = if first == last { Vec::new() } else { rows.row(last).to_vec() };
        [rows.row(first).to_vec(), second]
    };
    Ok(range.clone().map(of_pair).collect())
}

impl RadiosityItems {
    /// Rows of all patches.
    pub(super) fn rows(
        &self,
        patches: &Patches,
        parameters: &Parameters,
        progress: &mut ProgressFn<'_>,
    ) -> Result<FormFactorRows, StudyError> {
        let mut rows = room::rows(patches, parameters, &|_| false, progress)?;
        let count = patches.list().len();
        for (pair, values) in self.pairs.iter().enumerate() {
            let [first, last] = patches_of(pair, count);
            rows.set_row(first, &values[0])?;
            if first != last {
                rows.set_row(last, &values[1])?;
            }
        }
        Ok(rows)
    }
}
