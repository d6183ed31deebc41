//! Sweep over numbers of patches and open switches of the card: how the error depends on the size of the system, and on
//! guesses about the card.

use refsim::device::Profile;

use super::solve::room;
use super::{CardMethod, Parameters, ProgressFn, SolutionError, SolveMethod, StopReason, no_card};
use crate::radiosity::bias::{Accumulator, predicted};
use crate::radiosity::on_card::{CardSolver, Fit, Storage, to_f64};
use crate::radiosity::solve::Solver;
use crate::radiosity::{Patches, Subdivision, System};
use crate::study::StudyError;
use crate::study::configuration::Configuration;

/// Result for one number of patches, one method on the card, and one setting of its switches.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SweepRow {
    pub(super) patches: usize,
    pub(super) method: String,
    /// Switch that was changed, and its value; `None` for the card as configured.
    pub(super) switch: Option<(String, String)>,
    /// Index of the first row with the same bits, patches and method.
    pub(super) same_as: usize,
    pub(super) iterations: u32,
    pub(super) stopped: StopReason,
    pub(super) error: SolutionError,
    /// First-order prediction of [`SolutionError::bias`]; `None` for formats without exponents.
    pub(super) predicted: Option<f64>,
}

impl SweepRow {
    pub(super) fn setting(&self) -> String {
        self.switch.as_ref().map_or_else(|| "as it is".to_owned(), |(name, value)| format!("{name}={value}"))
    }
}

/// Rows by number of patches, method on the card, and value of a switch.
pub(super) fn rows(
    parameters: &Parameters,
    values: &[Configuration],
    progress: &mut ProgressFn<'_>,
) -> Result<Vec<SweepRow>, StudyError> {
    let methods: Vec<CardMethod> = parameters.methods.iter().filter_map(SolveMethod::on_card).collect();
    let sizes = if methods.is_empty() { &[][..] } else { &parameters.options.sweep[..] };
    let all = (methods.len() * values.len() * sizes.len()) as u64;
    let mut rows = Vec::new();
    for &size in sizes {
        let patches = Patches::new(&parameters.scene, Subdivision::AtMost(size as usize))?;
        require_fit(parameters, &patches)?;
        let factors = room(&patches, parameters, parameters.caster(), progress)?.factors;
        let system = System::new(factors, patches.reflectances(), patches.emittances())?;
        let reference = system.solve(Solver::Direct, &parameters.options.stopping())?.radiosity();
        for &how in &methods {
            let first = rows.len();
            let mut found: Vec<Vec<[f32; 3]>> = Vec::new();
            for setting in values {
                progress("sweep", rows.len() as u64, all);
                let (radiosity, row) = solved(how, setting, &system, &reference, parameters)?;
                let same = found.iter().position(|other| same_bits(other, &radiosity));
                rows.push(SweepRow { same_as: first + same.unwrap_or(found.len()), ..row });
                found.push(radiosity);
            }
        }
    }
    Ok(rows)
}

fn solved(
    how: CardMethod,
    setting: &Configuration,
    system: &System,
    reference: &[[f64; 3]],
    parameters: &Parameters,
) -> Result<(Vec<[f32; 3]>, SweepRow), StudyError> {
    let profile = &setting.profile;
    let executor = parameters.executor.clone();
    let card = CardSolver::new(profile.clone(), executor, system, how.packing, how.storage);
    let options = parameters.options.stopping();
    let solution = card.and_then(|mut card| card.solve(system, &options, &mut |_| ())).map_err(no_card)?;
    let row = SweepRow {
        patches: reference.len(),
        method: SolveMethod::Card(how).label(profile),
        switch: setting.switch.clone(),
        same_as: 0,
        iterations: solution.iterations(),
        stopped: StopReason::on_card(&solution),
        error: SolutionError::between(&to_f64(&solution.radiosity), reference, system.emittance()),
        predicted: bias(how, profile, system, reference)?,
    };
    Ok((solution.radiosity, row))
}

fn bias(
    how: CardMethod,
    profile: &Profile,
    system: &System,
    reference: &[[f64; 3]],
) -> Result<Option<f64>, StudyError> {
    let rules = &profile.rules;
    let format = if how.storage == Storage::Fp16 { rules.partial.unwrap_or(rules.format) } else { rules.format };
    let block = Fit::of(profile, how.packing).map_err(no_card)?.block;
    let Some(accumulator) = Accumulator::of(&format, how.packing, block) else { return Ok(None) };
    let error = predicted(system, reference, accumulator)?;
    let found: Vec<[f64; 3]> =
        reference.iter().zip(error).map(|(b, error)| [0, 1, 2].map(|c| b[c] + error[c])).collect();
    Ok(Some(SolutionError::between(&found, reference, system.emittance()).bias))
}

fn same_bits(a: &[[f32; 3]], b: &[[f32; 3]]) -> bool {
    a.iter().flatten().map(|x| x.to_bits()).eq(b.iter().flatten().map(|x| x.to_bits()))
}

/// Refuses patches whose system does not fit the card in the packing of a method.
pub(super) fn require_fit(parameters: &Parameters, patches: &Patches) -> Result<(), StudyError> {
    for how in parameters.methods.iter().filter_map(SolveMethod::on_card) {
        let require = |fit: Fit| fit.require(&parameters.profile, how.packing, patches.list().len());
        Fit::of(&parameters.profile, how.packing).and_then(require).map_err(no_card)?;
    }
    Ok(())
}
