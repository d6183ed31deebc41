//! Pictures of the study.

use super::outcome::PrecisionOutcome;
use super::runs::Runs;
use super::tables::number;
use crate::report::{Findings, NamedPicture};
use crate::study::StudyError;

/// Adds the pictures: exact, in the smallest uniform format, and with one bit less.
pub(super) fn pictures(found: &mut Findings, outcome: &PrecisionOutcome, runs: &Runs<'_>) -> Result<(), StudyError> {
    let profile = runs.subject.profile();
    let mut pictures = Vec::new();
    let mut add = |name: String, caption: String, device| -> Result<(), StudyError> {
        let measured = runs.shown(&device)?;
        let value = number(measured.value(&runs.goal.measure));
        let caption = format!("{caption}: {} {value}", runs.goal.words());
        pictures.extend(measured.picture.map(|picture| NamedPicture::new(name, picture, caption)));
        Ok(())
    };
    add("exact".to_owned(), "exact run".to_owned(), runs.uniform_device(profile, None))?;
    for minimum in outcome.families.iter().filter_map(|family| family.curve.minimum) {
        let less = minimum.narrower().next();
        for bits in [minimum].into_iter().chain(less) {
            add(bits.to_string(), format!("all instructions in {bits}"), runs.uniform_device(profile, Some(bits)))?;
        }
    }
    found.pictures(pictures);
    Ok(())
}
