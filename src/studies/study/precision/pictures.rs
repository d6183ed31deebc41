//! Pictures of the study.

use refsim::machine::ExecutorKind;

use super::outcome::{FamilyOutcome, PrecisionOutcome};
use super::runs::Runs;
use super::subject::ErrorMap;
use super::tables::{self, number};
use crate::report::{Findings, NamedPicture, false_color};
use crate::study::StudyError;

/// Adds the pictures: exact, in the smallest uniform format, and with one bit less.
pub(super) fn pictures(found: &mut Findings, outcome: &PrecisionOutcome, runs: &Runs<'_>) -> Result<(), StudyError> {
    let profile = runs.subject.profile();
    let mut pictures = Vec::new();
    let mut add = |name: String, caption: String, device| -> Result<(), StudyError> {
        let measured = runs.shown(&device, ExecutorKind::Batch)?;
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
    let errors = outcome.families.iter().filter_map(|family| of_most_blamed(family, runs).transpose());
    found.pictures(errors.collect::<Result<_, _>>()?);
    Ok(())
}

/// Errors of the pixels if only the most blamed instruction is rounded.
fn of_most_blamed(family: &FamilyOutcome, runs: &Runs<'_>) -> Result<Option<NamedPicture>, StudyError> {
    let (Some(blamed), Some((place, _))) = (family.blamed, family.most_blamed()) else { return Ok(None) };
    let device = runs.device(runs.subject.profile(), &runs.alone(place, blamed.bits));
    let Some(device) = device else { return Ok(None) };
    let Some(ErrorMap { width, unit, values }) = runs.shown(&device, ExecutorKind::Batch)?.errors else {
        return Ok(None);
    };
    let largest = values.iter().copied().filter(|value| value.is_finite()).fold(0.0, f64::max);
    let scale = if largest > 0.0 { largest } else { 1.0 };
    let shares: Vec<f64> = values.iter().map(|value| value / scale).collect();
    let line = tables::line(place, runs);
    let caption = format!(
        "errors with `{}` (line {}) alone in {}; the bar goes from 0 to {} {unit}{}",
        line.text,
        line.line,
        blamed.bits,
        number(scale),
        if shares.iter().all(|share| share.is_finite()) { "" } else { "; green where not finite" },
    );
    let name = format!("errors-{}", family.curve.family.name());
    Ok(Some(NamedPicture::new(name, false_color::magnitude(width, &shares), caption)))
}
