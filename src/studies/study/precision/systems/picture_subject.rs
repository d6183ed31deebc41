//! Systems whose values are compared with their own exact run.

use refsim::device::Profile;
use refsim::machine::{Executor, ExecutorKind};

use super::programs::PixelPrograms;
use super::run::{SystemInput, SystemRun};
use crate::picture::metrics::{ErrorSums, relative_error, value_error};
use crate::picture::{RgbImage, display, rgb8};
use crate::study::StudyError;
use crate::study::precision::goal::Goal;
use crate::study::precision::subject::{Measured, NOT_FINITE, PrecisionMeasure, PrecisionSubject, StudiedProgram};

const MEASURES: [PrecisionMeasure; 5] = [
    PrecisionMeasure {
        name: "largest_relative",
        meaning: "largest relative error of a channel; 1 where only the exact value is 0",
    },
    PrecisionMeasure { name: "mean_relative", meaning: "mean relative error of all channels" },
    PrecisionMeasure { name: "largest_255ths", meaning: "largest error of a channel, in 255ths of white" },
    PrecisionMeasure {
        name: "visible",
        meaning: "share of pixels or patches, in [0, 1], of which a channel is off by more than one 255th",
    },
    NOT_FINITE,
];

/// System whose exact values come from its run in single precision.
pub(super) struct SystemSubject {
    run: Box<dyn SystemRun>,
    profile: Profile,
    executor: Executor,
    programs: PixelPrograms,
    exact: Vec<[f64; 3]>,
    exact_held_back: Vec<[f64; 3]>,
}

impl SystemSubject {
    pub(super) fn new(run: Box<dyn SystemRun>, profile: Profile) -> Result<Self, StudyError> {
        let executor = ExecutorKind::Batch.into();
        let (programs, [exact, exact_held_back]) = PixelPrograms::of(&profile, &executor, |device, executor| {
            let values = |input| run.values(input, device, executor);
            Ok([values(SystemInput::Searched)?, values(SystemInput::HeldBack)?])
        })?;
        Ok(Self { run, profile, executor, programs, exact, exact_held_back })
    }
}

/// Errors of values.
struct SystemErrors {
    /// Values by the names of [`MEASURES`].
    values: Vec<(&'static str, f64)>,
    /// Index of the largest error, the first one on a tie; `None` if there are no errors.
    worst: Option<usize>,
}

/// Errors of values compared with exact ones.
fn errors(found: &[[f64; 3]], exact: &[[f64; 3]]) -> SystemErrors {
    let mut sums = ErrorSums::default();
    let mut off = Vec::with_capacity(exact.len());
    for (ours, right) in found.iter().zip(exact) {
        let mut most = 0.0_f64;
        for (&value, &right) in ours.iter().zip(right) {
            sums.add(relative_error(value, right), 1.0);
            // Rounds to a millionth, so that an 8-bit code, which is read in single precision, is exactly one 255th.
            most = most.max((1e6 * 255.0 * value_error(value, right).abs()).round() / 1e6);
        }
        off.push(most);
    }
    let most = off.iter().copied().fold(0.0, f64::max);
    let visible = off.iter().filter(|off| **off > 1.0).count();
    let count = exact.len().max(1) as f64;
    let values = vec![
        ("largest_relative", sums.largest),
        ("mean_relative", sums.mean()),
        ("largest_255ths", most),
        ("visible", visible as f64 / count),
        ("not_finite", sums.not_finite as f64),
    ];
    SystemErrors { values, worst: off.iter().position(|off| *off > 0.0 && *off == most) }
}

impl PrecisionSubject for SystemSubject {
    fn title(&self) -> String {
        self.run.title().to_owned()
    }

    fn profile(&self) -> &Profile {
        &self.profile
    }

    fn programs(&self) -> Vec<StudiedProgram<'_>> {
        self.programs.list()
    }

    fn measures(&self) -> &[PrecisionMeasure] {
        &MEASURES
    }

    fn default_goal(&self) -> Goal {
        self.run.default_goal()
    }

    fn measure(&self, profile: &Profile, wanted: Option<&str>) -> Result<Measured, StudyError> {
        let found = self.run.values(SystemInput::Searched, profile, &self.executor)?;
        let SystemErrors { values, worst } = errors(&found, &self.exact);
        let worst = worst.map(|at| {
            let place = match self.run.size() {
                Some([width, _]) => format!("pixel {}, {}", at as u32 % width, at as u32 / width),
                None => format!("{} {at}", self.run.unit()),
            };
            let [ours, exact] = [found[at], self.exact[at]].map(|rgb| rgb.map(|value| value as f32));
            format!("{place}: {ours:?}, not {exact:?}")
        });
        let shown = self.run.size().filter(|_| wanted.is_none());
        Ok(Measured { values, worst, picture: shown.map(|size| picture(size, &found)) })
    }

    fn held_back(&self, profile: &Profile) -> Result<Option<Measured>, StudyError> {
        let found = self.run.values(SystemInput::HeldBack, profile, &self.executor)?;
        let values = errors(&found, &self.exact_held_back).values;
        Ok(Some(Measured { values, ..Measured::default() }))
    }

    fn chooses_other_programs(&self, profile: &Profile) -> Result<bool, StudyError> {
        let run = |device: &Profile, executor: &Executor| self.run.values(SystemInput::Searched, device, executor);
        Ok(!PixelPrograms::of(profile, &self.executor, run)?.0.are_among(&self.programs))
    }
}

fn picture([width, height]: [u32; 2], values: &[[f64; 3]]) -> RgbImage {
    rgb8(width, height, values.iter().map(|pixel| pixel.map(display::encode)))
}
