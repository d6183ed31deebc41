//! Study of precision: how many bits a goal needs, and which instruction decides.
//!
//! A [`PrecisionSubject`] is run repeatedly with a number format per instruction. The exact run has single-precision
//! registers; a uniform run has all instructions in one format. docs/precision.md describes what is measured.

mod bits;
mod case;
mod curve;
mod errors;
mod expression;
mod goal;
mod half;
mod instructions;
mod outcome;
mod report;
mod runs;
mod search;
mod subject;
mod switches;
mod systems;
mod tables;

use super::{ProgressFn, Study, StudyError};
use crate::report::{Findings, Provenance};

pub use bits::FormatFamily;
pub use case::CaseSubject;
pub(in crate::study) use curve::BitScan;
pub use expression::{ExpressionError, ExpressionStudy, InputDraw};
pub use goal::Goal;
pub use outcome::Precision;
pub use subject::{Measured, PrecisionMeasure, PrecisionSubject, StudiedProgram};
pub use systems::PaperSystem;

impl Study for Precision {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let goal = self.goal()?;
        let mut runs = self.runs(&goal, progress)?;
        let outcome = self.outcome(&mut runs)?;
        report::findings(&outcome, &runs)
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        let profile = self.subject.profile();
        provenance.profiles.push(profile.name.clone());
        let set = profile.switches().iter().filter(|switch| switch.current != switch.default);
        provenance.switches.extend(set.map(|switch| (switch.name.clone(), switch.current.clone())));
        provenance
    }
}
