//! Study of measured pixels: the settings of a device's switches that reproduce what a card drew.
//!
//! docs/measuring.md describes how to measure.

mod file;
mod report;
mod settings;

use self::settings::Survey;
use super::error::library_errors;
use super::{ProgressFn, Study, StudyError};
use crate::case::CaseError;
use crate::report::{Findings, Provenance};

pub use file::{MeasuredCase, MeasuredPixel, load_measurement, parse_measurement};
pub use settings::Measure;

library_errors! {
    CaseError;
}

impl Study for Measure {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let survey = Survey::new(self, progress)?;
        Ok(report::findings(self, &survey))
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.profiles.push(self.profile.name.clone());
        provenance.switches.extend(self.known.iter().cloned());
        provenance
    }
}
