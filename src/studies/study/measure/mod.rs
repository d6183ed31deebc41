//! Study of measured pixels: the settings of a device's switches that draw what a card drew.
//!
//! docs/measuring.md describes how to measure.

mod file;
mod report;
mod settings;

use refsim::device::Profile;

use self::settings::Survey;
use super::error::library_errors;
use super::{ProgressFn, Study, StudyError};
use crate::case::CaseError;
use crate::report::{Findings, Provenance};

pub use file::{MeasuredCase, MeasuredPixel, load_measurement, parse_measurement};

library_errors! {
    CaseError;
}

/// Columns of codes.
const CODES: [&str; 5] = ["red", "green", "blue", "alpha", "depth"];

/// Measured pixels, held against a device.
#[derive(Clone, Debug)]
pub struct Measure {
    /// Name of the table.
    pub name: String,
    /// What the card drew.
    pub cases: Vec<MeasuredCase>,
    /// Device, with the known switches set.
    pub profile: Profile,
    /// Switches that are known, by name, with their values in `profile`.
    pub known: Vec<(String, String)>,
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
