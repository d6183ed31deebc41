//! Study of precision: how many bits a goal needs, and which instruction decides.
//!
//! A [`PrecisionSubject`] is run repeatedly with a number format per instruction. The exact run has single-precision
//! registers; a uniform run has all instructions in one format. docs/precision.md describes what is measured.

mod bits;
mod case;
mod costs;
mod curve;
mod executors;
mod expression;
mod family_report;
mod goal;
mod half;
mod half_report;
mod instructions;
mod known_runs;
mod outcome;
mod pictures;
mod refutation_tables;
mod refutations;
mod report;
mod runs;
mod sampled;
mod search;
mod split;
mod steps;
mod subject;
mod switches;
mod systems;
mod tables;
mod ulps;

use super::{ProgressFn, Study, StudyError};
use crate::report::{Findings, Provenance};
use crate::split::{Computed, SplitRun};

pub use bits::FormatFamily;
pub use case::CaseSubject;
pub use costs::FormatCosts;
pub use expression::{ExpressionError, ExpressionStudy, InputDraw};
pub use goal::{Goal, GoalError, GoalRelation};
pub use known_runs::KnownRuns;
pub use outcome::Precision;
pub use subject::{
    ErrorMap, FragmentResults, InstructionResults, Measured, PixelSteps, PrecisionMeasure, PrecisionSubject,
    RefutingDevices, RoundedInstruction, SampledResults, StepResult, StudiedProgram, WorstPlace,
};
pub use systems::PaperSystem;
#[doc(hidden)]
pub use systems::spread;

impl Study for Precision {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        self.findings_with(&self.known, progress)
    }

    fn findings_split(
        &self,
        split: &SplitRun,
        progress: &mut ProgressFn<'_>,
    ) -> Result<Computed<Findings>, StudyError> {
        let goal = self.goal()?;
        let of_range = |range| self.runs_of(range, &mut self.runs(&goal, &KnownRuns::default(), progress)?);
        split.known("searches", self.searches(), of_range)?.and_then(|made| match made {
            Some(made) => self.findings_with(&self.known.clone().with_parts(made.known), progress),
            None => self.findings(progress),
        })
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        let profile = self.subject.profile();
        provenance.profiles.push(profile.name.clone());
        let set = profile.switches().iter().filter(|switch| switch.current != switch.default);
        provenance.switches.extend(set.map(|switch| (switch.name.clone(), switch.current.clone())));
        provenance
    }
}

impl Precision {
    fn findings_with(&self, known: &KnownRuns, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let goal = self.goal()?;
        let mut runs = self.runs(&goal, known, progress)?;
        let outcome = self.outcome(&mut runs)?;
        report::findings(self, &outcome, &runs)
    }
}
