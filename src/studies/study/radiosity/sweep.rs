//! Sweep over numbers of patches and open switches of the card: the dependence of the error on the size of the system,
//! and on guesses about the card.

use refsim::device::Profile;

use super::{CardMethod, Parameters, ProgressFn, SolutionError, SolveMethod, StopReason, room};
use crate::radiosity::bias::{Accumulator, predicted};
use crate::radiosity::on_card::{CardOptions, CardSolver, Fit, Storage};
use crate::radiosity::solve::{Options, Solver};
use crate::radiosity::{Patches, Subdivision, System};
use crate::study::StudyError;
use crate::study::configuration::Configuration;

/// Result for one number of patches, one method on the card, and one setting of its switches.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepRow {
    /// Number of patches.
    pub patches: usize,
    /// Name of the method.
    pub method: String,
    /// Switch that was changed, and its value; `None` for the card as configured.
    pub switch: Option<(String, String)>,
    /// Index of the first row of the sweep with the same bits: this one, or an earlier one of the same patches and
    /// method.
    pub same_as: usize,
    /// Number of iterations.
    pub iterations: u32,
    /// Reason why it stopped.
    pub stopped: StopReason,
    /// Error against the direct solution.
    pub error: SolutionError,
    /// First-order prediction of [`SolutionError::bias`]; `None` for formats without exponents.
    pub predicted: Option<f64>,
}

impl SweepRow {
    /// Formats the setting.
    pub fn setting(&self) -> String {
        self.switch.as_ref().map_or_else(|| "as it is".to_owned(), |(name, value)| format!("{name}={value}"))
    }
}

/// Runs the sweep: rows by patches, method and settings.
pub(super) fn run(parameters: &Parameters, progress: &mut ProgressFn<'_>) -> Result<Vec<SweepRow>, StudyError> {
    let on_card = |method: &SolveMethod| if let SolveMethod::Card(how) = method { Some(*how) } else { None };
    let methods: Vec<CardMethod> = parameters.methods.iter().filter_map(on_card).collect();
    let settings = Configuration::of(&parameters.profile).under_each_switch()?;
    let (mut rows, mut done) = (Vec::new(), 0);
    let all = (parameters.sweep.len() * methods.len() * settings.len()) as u64;
    for &size in &parameters.sweep {
        let patches = Patches::new(&parameters.scene, Subdivision::AtMost(size as usize))?;
        for how in &methods {
            let fit = Fit::of(&parameters.profile, how.packing)?;
            fit.require(&parameters.profile, how.packing, patches.list().len())?;
        }
        let factors = room::find(&patches, parameters, progress)?.factors;
        let system = System::new(factors, patches.reflectances(), patches.emittances())?;
        let reference = system.solve(Solver::Direct, &parameters.options, None)?.radiosity();
        for &how in &methods {
            let mut found: Vec<(usize, Vec<[f32; 3]>)> = Vec::new();
            for setting in &settings {
                progress("sweep", done, all);
                done += 1;
                let (radiosity, row) = solved(how, setting, &system, &reference, parameters)?;
                let same = found.iter().find(|(_, other)| same_bits(other, &radiosity)).map(|(row, _)| *row);
                if same.is_none() {
                    found.push((rows.len(), radiosity));
                }
                rows.push(SweepRow { same_as: same.unwrap_or(rows.len()), ..row });
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
    let mut card = CardSolver::new(profile.clone(), parameters.executor.clone(), system, how.packing, how.storage)?;
    let Options { tolerance, most_iterations } = parameters.options;
    let options = CardOptions { tolerance, most_iterations, check_every: 1 };
    let solution = card.solve(system, &options, &mut |_| ())?;
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

/// Bias predicted for rounding alone.
fn bias(
    how: CardMethod,
    profile: &Profile,
    system: &System,
    reference: &[[f64; 3]],
) -> Result<Option<f64>, StudyError> {
    let rules = &profile.rules;
    let format = if how.storage == Storage::Fp16 { rules.partial.unwrap_or(rules.format) } else { rules.format };
    let block = Fit::of(profile, how.packing)?.block;
    let Some(accumulator) = Accumulator::of(&format, how.packing, block) else { return Ok(None) };
    let error = predicted(system, reference, accumulator)?;
    let found: Vec<[f64; 3]> =
        reference.iter().zip(error).map(|(b, error)| [0, 1, 2].map(|c| b[c] + error[c])).collect();
    Ok(Some(SolutionError::between(&found, reference, system.emittance()).bias))
}

fn same_bits(a: &[[f32; 3]], b: &[[f32; 3]]) -> bool {
    a.iter().flatten().map(|x| x.to_bits()).eq(b.iter().flatten().map(|x| x.to_bits()))
}
