//! Parts of a study: a part makes the runs of some searches, which the merge then reuses.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::curve::Curve;
use super::known_runs::KnownRuns;
use super::outcome::{FamilyOutcome, Precision, exact_run};
use super::runs::{RunError, Runs};
use super::search::STARTS;
use crate::split::Concatenate;
use crate::study::StudyError;

/// Runs that were made for consecutive searches.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct RunsOfSearches {
    searches: usize,
    pub(super) known: KnownRuns,
}

impl Concatenate for RunsOfSearches {
    fn are_of(&self, range: &Range<usize>) -> bool {
        self.searches == range.len()
    }

    fn append(&mut self, next: Self) {
        self.searches += next.searches;
        self.known.add(next.known);
    }
}

impl Precision {
    /// Number of searches: each start in each family of formats.
    pub(super) fn searches(&self) -> usize {
        self.families.len() * STARTS.len()
    }

    /// Makes the runs of a range of searches. If the budget is spent, the merge continues.
    pub(super) fn runs_of(&self, range: Range<usize>, runs: &mut Runs<'_>) -> Result<RunsOfSearches, StudyError> {
        match range.clone().try_for_each(|number| self.search_of(number, runs)) {
            Ok(()) | Err(RunError::Budget) => Ok(RunsOfSearches { searches: range.len(), known: runs.known.clone() }),
            Err(RunError::Study(error)) => Err(error),
        }
    }

    /// Makes the runs of one search. Runs for the curve and the blame, which all searches of a family need, are made
    /// once.
    fn search_of(&self, number: usize, runs: &mut Runs<'_>) -> Result<(), RunError> {
        exact_run(runs)?;
        let family = self.families[number / STARTS.len()];
        let mut outcome = FamilyOutcome::new(Curve::empty(family), runs.count());
        outcome.run_share(number % STARTS.len(), &self.costs, runs)
    }
}
