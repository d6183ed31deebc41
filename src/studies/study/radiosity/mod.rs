//! Study of the radiosity of a scene by several methods: on a card, by a solver on the host, and directly.
//!
//! It measures the cost of each method (iterations, passes, time) and its error relative to the direct solution, and
//! renders the room.

mod conclusion;
mod leaks;
mod method;
mod options;
mod outcome;
mod pictures;
mod report;
mod solve;
mod sweep;
mod tables;
mod time;

use crate::picture::metrics::value_error;
use crate::radiosity::form_factor::VisibilityParameters;
use crate::radiosity::rate::RateError;
use crate::radiosity::{DrawError, Patches, System};
use crate::report::{Findings, Provenance};
use crate::study::configuration::Configuration;
use crate::study::error::library_errors;
use crate::study::{ProgressFn, Study, StudyError};

pub(in crate::study) use method::no_card;
pub use method::{CardMethod, SolveMethod};
pub use options::{Factors, Parameters, RadiosityOptions};

use method::StopReason;
use outcome::{MethodRow, RadiosityOutcome};
use pictures::PictureRenderer;
pub(in crate::study) use pictures::exposure;
pub(in crate::study) use solve::SolutionError;
use sweep::{SweepRow, require_fit};

library_errors! {
    DrawError => "radiosity::display";
    RateError => "radiosity::rate";
}

impl Study for Parameters {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        report::findings(self, &run(self, progress)?)
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.profiles.push(self.profile.name.clone());
        provenance.switches.clone_from(&self.switches);
        let engines = self.casters.iter().filter(|caster| caster.profile().is_some());
        provenance.profiles.extend(engines.map(|caster| caster.label().to_owned()));
        if let Factors::Rays(VisibilityParameters { seed, .. }) = self.options.factors {
            provenance.seed = Some(seed);
        }
        provenance
    }
}

/// Solves by every method, draws the pictures, and runs the sweep.
fn run(parameters: &Parameters, progress: &mut ProgressFn<'_>) -> Result<RadiosityOutcome, StudyError> {
    // Before the patches and their form factors, which take long.
    if parameters.scene.emitters().is_empty() {
        let dark = StudyError::new("radiosity::dark", "expected a scene with a material that emits light, found none");
        return Err(dark.with_help("give a material an emission: `Ke` in an MTL file"));
    }
    let patches = Patches::new(&parameters.scene, parameters.options.subdivision())?;
    require_fit(parameters, &patches)?;
    let settings = Configuration::of(&parameters.profile).under_each_switch()?;
    let room = solve::room(&patches, parameters, parameters.caster(), progress)?;
    let leaks = leaks::rows(parameters, &patches, &room, progress)?;
    let system = System::new(room.factors, patches.reflectances(), patches.emittances())?;
    let mut solved = Vec::new();
    for (at, method) in parameters.methods.iter().enumerate() {
        let step = format!("solving: {}", method.label(&parameters.profile));
        progress(&step, at as u64, parameters.methods.len() as u64);
        solved.push(solve::solve(*method, &system, parameters)?);
    }
    let direct = solved.iter().find(|s| s.method == SolveMethod::DIRECT);
    let reference = direct.map(|s| s.radiosity.clone());
    let brightness = |s: &solve::Solved| exposure(&patches, system.emittance(), &s.radiosity);
    let exposure = direct.or(solved.first()).map_or(1.0, brightness);
    let mut studio = PictureRenderer::new(&patches, parameters, exposure, reference.as_deref())?;
    let frames = studio.frames(&solved)?;
    let (mut rows, methods) = (Vec::new(), solved.len() as u64);
    for one in solved {
        progress(&format!("drawing: {}", one.method.label(&parameters.profile)), rows.len() as u64, methods);
        rows.push(row(one, &system, reference.as_deref(), &mut studio, parameters)?);
    }
    drop(studio);
    let sweep = sweep::rows(parameters, &settings, progress)?;
    Ok(RadiosityOutcome { found_sums: room.found_sums, leaks, exposure, rows, frames, sweep, patches })
}

fn row(
    mut one: solve::Solved,
    system: &System,
    reference: Option<&[[f64; 3]]>,
    studio: &mut PictureRenderer<'_>,
    parameters: &Parameters,
) -> Result<MethodRow, StudyError> {
    let (pictures, card) = studio.show(&mut one, system)?;
    let last = one.history.last().copied().unwrap_or(f64::NAN);
    Ok(MethodRow {
        label: one.method.label(&parameters.profile),
        residual: (last / one.emitted).sqrt(),
        energy_balance_error: energy_balance_error(system, &one.radiosity),
        error: reference.map(|reference| SolutionError::between(&one.radiosity, reference, system.emittance())),
        pictures,
        card,
        method: one.method,
        radiosity: one.radiosity,
        history: one.history,
        stopped: one.stopped,
    })
}

/// Energy-balance error relative to the emitted power; the maximum over the emitting channels.
fn energy_balance_error(system: &System, radiosity: &[[f64; 3]]) -> f64 {
    let left = system.energy_balance_error(radiosity);
    let emitted = |c: usize| -> f64 {
        system.factors().areas().iter().zip(system.emittance()).map(|(area, e)| area * e[c]).sum()
    };
    (0..3).filter(|&c| emitted(c) > 0.0).map(|c| value_error(left[c], 0.0).abs() / emitted(c)).fold(0.0, f64::max)
}
