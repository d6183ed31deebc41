//! Ranges and errors of the instructions' results in a sample of fragments.

use super::outcome::PrecisionOutcome;
use super::runs::{RunError, Runs};
use super::subject::RoundedInstruction;
use super::ulps::{errors_of, local_error, range_of};

/// Finds the range of each instruction's exact results, and in each family the error of its results in the smallest
/// uniform format against the exact results of the same operands. An unrolled loop has those of all its instructions,
/// rounded one at a time, as the operands of the next would not be exact otherwise.
pub(super) fn sample_results(runs: &mut Runs<'_>, outcome: &mut PrecisionOutcome) -> Result<(), RunError> {
    runs.step("ranges");
    let mut rounded = Vec::new();
    let given = runs.subject.profile().rules.format;
    for minimum in outcome.families.iter().filter_map(|family| family.curve.minimum) {
        let of = |program, instruction| RoundedInstruction { program, instruction, format: minimum.format(given) };
        let places = runs.places.iter();
        rounded.extend(places.flat_map(|place| place.instructions().map(|at| of(place.program, at))));
    }
    let sampled = runs.results(&rounded)?;
    let exact = |program: usize, at: usize| sampled.exact.get(program)?.get(&at);
    let results = |program: usize, at: usize| exact(program, at).into_iter().flat_map(|results| results.values());
    for place in &runs.places {
        let mut all = place.instructions().flat_map(|at| results(place.program, at)).peekable();
        outcome.ranges.push(all.peek().is_some().then(|| range_of(all)));
    }
    let mut found = sampled.rounded.iter();
    for family in &mut outcome.families {
        let Some(minimum) = family.curve.minimum else { continue };
        for (place, needs) in runs.places.iter().zip(&mut family.needs) {
            let own = place.instructions().zip(&mut found);
            let own = own.filter_map(|(at, rounded)| Some((exact(place.program, at)?, rounded)));
            needs.local = local_error(own.flat_map(|(exact, rounded)| errors_of(minimum, exact, rounded)));
        }
    }
    Ok(())
}
