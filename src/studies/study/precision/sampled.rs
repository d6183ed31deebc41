//! Ranges and errors of the instructions' results in a sample of fragments.

use super::bits::FormatBits;
use super::runs::{RunError, Runs};
use super::subject::RoundedInstruction;
use super::ulps::{LocalError, ResultRange, errors_of, local_error, range_of};

/// Results of sampling, by instruction; `None` for an instruction that was not executed.
#[derive(Debug)]
pub(super) struct SampleFindings {
    /// Ranges of the exact results.
    pub(super) ranges: Vec<Option<ResultRange>>,
    /// Errors of results in each format, compared with the exact results of the same operands.
    pub(super) errors: Vec<Vec<Option<LocalError>>>,
}

/// Samples the results of each instruction in the exact run, and rounded to each of some formats. Instructions of an
/// unrolled loop are rounded one at a time, so that the operands of the later ones stay exact.
pub(super) fn sample_results(formats: &[FormatBits], runs: &mut Runs<'_>) -> Result<SampleFindings, RunError> {
    runs.step("ranges");
    let mut rounded = Vec::new();
    let given = runs.subject.profile().rules.format;
    for bits in formats {
        let of = |program, instruction| RoundedInstruction { program, instruction, format: bits.format(given) };
        let places = runs.places.iter();
        rounded.extend(places.flat_map(|place| place.instructions().map(|at| of(place.program, at))));
    }
    let sampled = runs.results(&rounded)?;
    let exact = |program: usize, at: usize| sampled.exact.get(program)?.get(&at);
    let results = |program: usize, at: usize| exact(program, at).into_iter().flat_map(|results| results.values());
    let ranges = runs.places.iter().map(|place| {
        let mut all = place.instructions().flat_map(|at| results(place.program, at)).peekable();
        all.peek().is_some().then(|| range_of(all))
    });
    let mut found = sampled.rounded.iter();
    let mut errors_in = |bits: FormatBits| {
        let of_place = runs.places.iter().map(|place| {
            let own = place.instructions().zip(&mut found);
            let own = own.filter_map(|(at, rounded)| Some((exact(place.program, at)?, rounded)));
            local_error(own.flat_map(|(exact, rounded)| errors_of(bits, exact, rounded)))
        });
        of_place.collect()
    };
    let errors = formats.iter().map(|bits| errors_in(*bits)).collect();
    Ok(SampleFindings { ranges: ranges.collect(), errors })
}
