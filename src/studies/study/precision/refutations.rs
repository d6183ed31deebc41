//! Traces of refutations: the pixel at which a format with one bit less misses the goal, instruction by instruction.

use super::bits::Assignment;
use super::runs::Runs;
use super::search::{MixedFormats, RefutedFormat};
use super::subject::{StepResult, WorstPlace};
use crate::study::StudyError;

/// Results of the instructions at the worst pixel of a refutation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RefutationTrace {
    pub(super) refuted: RefutedFormat,
    /// Column and row.
    pub(super) pixel: [u32; 2],
    /// Results of the exact run, with the mixed formats, and with one bit less.
    pub(super) steps: [Vec<StepResult>; 3],
}

/// Traces each format that was refuted, as far as the subject has traces.
pub(super) fn traces(mixed: &MixedFormats, runs: &Runs<'_>) -> Result<Vec<RefutationTrace>, StudyError> {
    let mut found = Vec::new();
    let formats: Assignment = mixed.formats.iter().copied().map(Some).collect();
    for refuted in &mixed.refuted {
        let Some(WorstPlace { pixel: Some(pixel), .. }) = refuted.worst else { continue };
        let mut less = formats.clone();
        less[refuted.place] = Some(refuted.bits);
        let exact = vec![None; formats.len()];
        let steps = |assignment: &Assignment| match runs.device(runs.subject.profile(), assignment) {
            Some(device) => runs.subject.steps(&device, pixel),
            None => Ok(None),
        };
        if let [Some(exact), Some(mixed), Some(less)] = [steps(&exact)?, steps(&formats)?, steps(&less)?] {
            found.push(RefutationTrace { refuted: refuted.clone(), pixel, steps: [exact, mixed, less] });
        }
    }
    Ok(found)
}
