//! Items that a divided run computes in parts: rows of form factors, and runs of the sweep.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::room;
use super::sweep::{Sweep, SweepRun};
use super::{Parameters, ProgressFn};
use crate::radiosity::Patches;
use crate::radiosity::form_factor::FormFactorRows;
use crate::split::{Computed, Concatenate, SplitRun};
use crate::study::StudyError;
use crate::study::caster::CasterChoice;

/// Results of consecutive items. An item is a share of the rows of form factors and of the settings of the sweep.
///
/// Rows come in pairs, the first with the last, the second with the last but one, and so on: a row only has the
/// exchanges with later patches, so pairs make the costs equal.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct RadiosityItems {
    items: usize,
    /// Rows of form factors, pair by pair.
    rows: Vec<Vec<f64>>,
    /// Runs by setting, then by number of patches.
    pub(super) sweep: Vec<Vec<SweepRun>>,
}

impl Concatenate for RadiosityItems {
    fn are_of(&self, range: &Range<usize>) -> bool {
        self.items == range.len()
    }

    fn append(&mut self, next: Self) {
        self.items += next.items;
        self.rows.extend(next.rows);
        self.sweep.extend(next.sweep);
    }
}

/// Computes a part, or reads the results of parts.
pub(super) fn known(
    split: &SplitRun,
    patches: &Patches,
    sweep: &Sweep<'_>,
    progress: &mut ProgressFn<'_>,
) -> Result<Computed<Option<RadiosityItems>>, StudyError> {
    let (pairs, settings) = (patches.list().len().div_ceil(2), sweep.count());
    let items = pairs.max(settings);
    split.known("shares of rows and settings", items, |range| {
        let share = |count: usize| range.start * count / items.max(1)..range.end * count / items.max(1);
        let sweep_runs = sweep.runs(share(settings), progress)?;
        let rows = rows_of_pairs(share(pairs), patches, sweep.parameters, progress)?;
        Ok(RadiosityItems { items: range.len(), rows, sweep: sweep_runs })
    })
}

/// Patches in the given pairs; the middle patch of an odd number is alone.
fn patches_of(pairs: Range<usize>, count: usize) -> impl Iterator<Item = usize> {
    pairs.flat_map(move |pair| {
        let last = count - 1 - pair;
        [Some(pair), (last != pair).then_some(last)].into_iter().flatten()
    })
}

fn rows_of_pairs(
    pairs: Range<usize>,
    patches: &Patches,
    parameters: &Parameters,
    progress: &mut ProgressFn<'_>,
) -> Result<Vec<Vec<f64>>, StudyError> {
    let count = patches.list().len();
    let is_wanted = |patch: usize| pairs.contains(&patch.min(count - 1 - patch));
    let (rows, _) = room::rows(patches, parameters, &CasterChoice::Host, &is_wanted, progress)?;
    Ok(patches_of(pairs.clone(), count).map(|patch| rows.row(patch).to_vec()).collect())
}

impl RadiosityItems {
    /// Rows of all patches.
    pub(super) fn form_factor_rows(
        &self,
        patches: &Patches,
        parameters: &Parameters,
        progress: &mut ProgressFn<'_>,
    ) -> Result<FormFactorRows, StudyError> {
        let (mut rows, _) = room::rows(patches, parameters, &CasterChoice::Host, &|_| false, progress)?;
        let count = patches.list().len();
        for (patch, values) in patches_of(0..count.div_ceil(2), count).zip(&self.rows) {
            rows.set_row(patch, values)?;
        }
        Ok(rows)
    }
}
