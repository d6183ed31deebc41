//! Traces of refutations: the pixel at which a format with one bit less misses the goal, instruction by instruction.

use super::bits::Assignment;
use super::runs::Runs;
use super::search::{MixedFormats, RefutedFormat};
use super::subject::{PixelSteps, RefutingDevices, WorstPlace};
use crate::study::StudyError;

/// Results of the instructions at the pixel of a refutation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RefutationTrace {
    pub(super) refuted: RefutedFormat,
    pub(super) traced: PixelSteps,
}

/// Traces each refuted format, if the subject has traces.
pub(super) fn traces(mixed: &MixedFormats, runs: &Runs<'_>) -> Result<Vec<RefutationTrace>, StudyError> {
    let mut found = Vec::new();
    let formats: Assignment = mixed.formats.iter().copied().map(Some).collect();
    let device = |assignment: &Assignment| runs.device(runs.subject.profile(), assignment);
    let Some((exact, enough)) = device(&vec![None; formats.len()]).zip(device(&formats)) else { return Ok(found) };
    for refuted in &mixed.refuted {
        let Some(WorstPlace { pixel: Some(pixel), .. }) = refuted.worst else { continue };
        let mut less = formats.clone();
        less[refuted.place] = Some(refuted.bits);
        let Some(less) = device(&less) else { continue };
        let program = runs.places[refuted.place].program;
        let devices = RefutingDevices { exact: &exact, mixed: &enough, less: &less, program };
        let traced = runs.subject.steps(devices, pixel)?;
        found.extend(traced.map(|traced| RefutationTrace { refuted: refuted.clone(), traced }));
    }
    Ok(found)
}
