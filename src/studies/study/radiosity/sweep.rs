//! Sweep over numbers of patches and open switches of the card: how the error depends on the size of the system, and on
//! guesses about the card.

use refsim::device::Profile;

use super::solve::room;
use super::{CardMethod, Parameters, ProgressFn, SolutionError, SolveMethod, StopReason, no_card};
use crate::radiosity::bias::{Accumulator, predicted};
use crate::radiosity::on_card::{CardSolver, Fit, Storage};
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
    /// Index of the first row of the sweep with the same bits: this row, or an earlier one with the same patches and
    /// method.
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

/// Sweep over numbers of patches, for each setting of the card: a method with the value of a switch.
pub(super) struct Sweep<'a> {
    pub(super) parameters: &'a Parameters,
    /// Settings by method, then by value of a switch.
    settings: Vec<(CardMethod, Configuration)>,
    values: usize,
}

impl<'a> Sweep<'a> {
    pub(super) fn new(parameters: &'a Parameters) -> Result<Self, StudyError> {
        let on_card = |method: &SolveMethod| if let SolveMethod::Card(how) = method { Some(*how) } else { None };
        let values = Configuration::of(&parameters.profile).under_each_switch()?;
        let methods = parameters.methods.iter().filter_map(on_card);
        let settings = methods.flat_map(|how| values.iter().map(move |value| (how, value.clone()))).collect();
        Ok(Self { parameters, settings, values: values.len() })
    }

    /// Rows by number of patches, method and value. Rows of one number of patches and one method may have the same
    /// bits.
    pub(super) fn rows(&self, progress: &mut ProgressFn<'_>) -> Result<Vec<SweepRow>, StudyError> {
        let mut rows = Vec::new();
        if self.settings.is_empty() {
            return Ok(rows);
        }
        let all = (self.settings.len() * self.parameters.options.sweep.len()) as u64;
        for &size in &self.parameters.options.sweep {
            let (system, reference) = self.system(size, progress)?;
            for of_method in self.settings.chunks(self.values) {
                let first = rows.len();
                let mut found: Vec<Vec<[f32; 3]>> = Vec::new();
                for (how, setting) in of_method {
                    progress("sweep", rows.len() as u64, all);
                    let (radiosity, row) = solved(*how, setting, &system, &reference, self.parameters)?;
                    let same = found.iter().position(|other| same_bits(other, &radiosity));
                    rows.push(SweepRow { same_as: first + same.unwrap_or(found.len()), ..row });
                    found.push(radiosity);
                }
            }
        }
        Ok(rows)
    }

    fn system(&self, size: u32, progress: &mut ProgressFn<'_>) -> Result<(System, Vec<[f64; 3]>), StudyError> {
        let patches = Patches::new(&self.parameters.scene, Subdivision::AtMost(size as usize))?;
        for (how, _) in self.settings.iter().step_by(self.values) {
            let require = |fit: Fit| fit.require(&self.parameters.profile, how.packing, patches.list().len());
            Fit::of(&self.parameters.profile, how.packing).and_then(require).map_err(no_card)?;
        }
        let factors = room(&patches, self.parameters, self.parameters.caster(), progress)?.factors;
        let system = System::new(factors, patches.reflectances(), patches.emittances())?;
        let reference = system.solve(Solver::Direct, &self.parameters.options.stopping())?.radiosity();
        Ok((system, reference))
    }
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
    let widened: Vec<[f64; 3]> = solution.radiosity.iter().map(|b| b.map(f64::from)).collect();
    let row = SweepRow {
        patches: reference.len(),
        method: SolveMethod::Card(how).label(profile),
        switch: setting.switch.clone(),
        same_as: 0,
        iterations: solution.iterations(),
        stopped: StopReason::on_card(&solution),
        error: SolutionError::between(&widened, reference, system.emittance()),
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
