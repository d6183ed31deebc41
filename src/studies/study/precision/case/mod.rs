//! Case files as subjects.

mod drawn;
mod errors;

use refsim::device::Profile;
use refsim::machine::{Executor, ExecutorKind};

use super::goal::Goal;
use super::runs::exact;
use super::subject::{Measured, PrecisionMeasure, PrecisionSubject, StudiedProgram};
use crate::case::{CaseError, Setup};
use crate::picture::metrics::{DEFAULT_PPD, flip, ssim};
use crate::shader::ShaderText;
use crate::study::StudyError;
use drawn::{DrawnCase, codes};
use errors::{CaseErrors, FLIP, LARGEST_CODES, MEASURES, SSIM};

/// Case whose pixel program is studied. The reference is its exact run.
#[derive(Debug)]
pub struct CaseSubject {
    setup: Setup,
    title: String,
    executor: Executor,
    measures: Vec<PrecisionMeasure>,
    exact: DrawnCase,
    /// Another case with the same pixel program, which tests the mixed formats that were searched on this one.
    held_back: Option<Box<CaseSubject>>,
}

impl CaseSubject {
    /// Draws the exact run of a case, whose device is used unchanged. `name` is the title of a case without one. Fails
    /// if the device cannot draw the case.
    pub fn new(setup: Setup, name: &str) -> Result<Self, StudyError> {
        let executor = ExecutorKind::Batch.into();
        let exact = DrawnCase::new(&setup, &executor, &exact(&setup.profile, [&*setup.pixel]))?;
        let screen = exact.screen(setup.size)?;
        let perceptual = [(SSIM, ssim(&screen, &screen).is_some()), (FLIP, true)];
        let first = exact.has_codes().then_some(LARGEST_CODES);
        let last = perceptual.into_iter().filter(|(_, has)| *has).map(|(measure, _)| measure);
        let title = setup.title.clone().unwrap_or_else(|| name.to_owned());
        let measures = first.into_iter().chain(MEASURES).chain(last).collect();
        Ok(Self { title, executor, measures, exact, setup, held_back: None })
    }

    /// Holds back a case: formats found on this case are tested on it, on this case's device. `name` says where it
    /// comes from. Fails if it has another pixel program, this case's device cannot draw it, or it lacks a measure of
    /// this case.
    pub fn holding_back(mut self, other: &Setup, name: &str) -> Result<Self, StudyError> {
        let other = Self::new(other.on_device(self.setup.profile.clone())?, name)?;
        let refused = |expected: &str, found: &str, help: &str| {
            let text = format!("{name}: expected {expected}, found {found}");
            StudyError::new("crossbar::precision::held_back", text).with_help(help)
        };
        if other.setup.pixel.digest() != self.setup.pixel.digest() {
            let help = "name a case with other textures, constants or geometry";
            return Err(refused("a case with the same pixel program", "another program", help));
        }
        let has = |measure: &PrecisionMeasure| other.measures.iter().any(|own| own.name == measure.name);
        if let Some(missing) = self.measures.iter().find(|measure| !has(measure)) {
            let expected = format!("a case with the measure `{}`", missing.name);
            return Err(refused(
                &expected,
                "none",
                "give its targets the formats and sizes of the case that is searched",
            ));
        }
        self.held_back = Some(Box::new(other));
        Ok(self)
    }
}

impl PrecisionSubject for CaseSubject {
    fn title(&self) -> String {
        self.title.clone()
    }

    fn profile(&self) -> &Profile {
        &self.setup.profile
    }

    fn programs(&self) -> Vec<StudiedProgram<'_>> {
        vec![StudiedProgram { program: &self.setup.pixel, text: &self.setup.pixel_text }]
    }

    fn measures(&self) -> &[PrecisionMeasure] {
        &self.measures
    }

    /// One code, or one percent on the average where no target has codes.
    fn default_goal(&self) -> Goal {
        let first = self.measures[0];
        let bound = if first == LARGEST_CODES { 1.0 } else { 0.01 };
        Goal::at_most(first.name, bound)
    }

    fn measure(&self, profile: &Profile, wanted: Option<&str>) -> Result<Measured, StudyError> {
        self.measured(&self.setup, profile, wanted)
    }

    fn measure_text(&self, text: &ShaderText, wanted: &str) -> Result<Option<Measured>, StudyError> {
        let profile = exact(&self.setup.profile, []);
        let pixel = text.assemble().and_then(|program| text.check(program, &profile)).map_err(CaseError::from)?;
        let setup = Setup { pixel, pixel_text: text.clone(), ..self.setup.clone() };
        Ok(Some(self.measured(&setup, &profile, Some(wanted))?))
    }

    fn held_back(&self, profile: &Profile) -> Result<Option<Measured>, StudyError> {
        let measure = |other: &Self| other.measure(profile, None);
        self.held_back.as_deref().map(measure).transpose()
    }

    fn notes(&self) -> Vec<String> {
        let all = || self.exact.targets.iter().flat_map(|target| &target.values);
        let not_finite = all().filter(|value| !value.is_finite()).count();
        let note = || format!("Of {} channels of the exact run {not_finite} are infinite or NaN.", all().count());
        let warnings = self.setup.warnings.iter().map(|warning| format!("Warning: {warning}."));
        (not_finite > 0).then(note).into_iter().chain(warnings).collect()
    }
}

impl CaseSubject {
    /// Draws a case of the same size and targets, and measures it against the exact run.
    fn measured(&self, setup: &Setup, profile: &Profile, wanted: Option<&str>) -> Result<Measured, StudyError> {
        let drawn = DrawnCase::new(setup, &self.executor, profile)?;
        let [width, height] = self.setup.size;
        let errors = CaseErrors::new(&drawn, &self.exact, width as usize * height as usize);
        let known = errors.values().into_iter().filter(|(name, _)| self.measures.iter().any(|m| m.name == *name));
        let mut values: Vec<(&'static str, f64)> = known.collect();
        if wanted.is_none_or(|wanted| [SSIM.name, FLIP.name].contains(&wanted)) {
            let [ours, exact] = [drawn.screen(self.setup.size)?, self.exact.screen(self.setup.size)?];
            values.extend(ssim(&ours, &exact).map(|ssim| (SSIM.name, ssim)));
            values.extend(flip(&ours, &exact, DEFAULT_PPD).map(|flip| (FLIP.name, flip.mean)));
        }
        Ok(Measured {
            values,
            worst: errors.worst.map(|worst| self.place(worst, &drawn)),
            picture: wanted.is_none().then(|| drawn.picture(self.setup.size)),
        })
    }

    /// Describes the location of a value, and the exact value there.
    fn place(&self, (target, at, _): (usize, usize, f64), drawn: &DrawnCase) -> String {
        let (ours, exact) = (&drawn.targets[target], &self.exact.targets[target]);
        let (pixel, channel) = (at / exact.channels.len(), exact.channels[at % exact.channels.len()]);
        let width = self.setup.size[0] as usize;
        let name = ["red", "green", "blue", "alpha"].get(usize::from(channel.stored_from)).copied().unwrap_or_default();
        let of = if self.exact.targets.len() > 1 { format!(" of target {target}") } else { String::new() };
        let (x, y) = (pixel % width, pixel / width);
        match codes(channel) {
            Some(codes) => {
                let [ours, exact] = [ours, exact].map(|target| (target.values[at] * codes).round());
                format!("{x}, {y}{of}: {name} {ours}, not {exact}")
            }
            None => format!("{x}, {y}{of}: {name} {}, not {}", ours.values[at] as f32, exact.values[at] as f32),
        }
    }
}
