//! Runs of a subject with a format per instruction. Each run is made once and counted against the budget.

use std::collections::BTreeMap;

use refsim::device::Profile;
use refsim::isa::Program;
use refsim::num::Format;

use super::bits::{Assignment, FormatBits};
use super::goal::Goal;
use super::subject::{InstructionPlace, Measured, PrecisionSubject, StudiedProgram, places};
use crate::study::{ProgressFn, StudyError};

/// Reason why a search ends.
#[derive(Debug)]
pub(super) enum RunError {
    /// The budget is spent.
    Budget,
    /// The subject failed.
    Study(StudyError),
}

impl From<StudyError> for RunError {
    fn from(error: StudyError) -> Self {
        Self::Study(error)
    }
}

/// Runs of a subject.
pub(super) struct Runs<'a> {
    pub(super) subject: &'a dyn PrecisionSubject,
    pub(super) goal: &'a Goal,
    pub(super) programs: Vec<StudiedProgram<'a>>,
    pub(super) places: Vec<InstructionPlace>,
    /// Maximum number of runs.
    budget: u64,
    /// Number of runs made.
    pub(super) made: u64,
    /// Values of the goal's measure, and the location of the largest error.
    values: BTreeMap<Assignment, (f64, Option<String>)>,
    /// Number of runs that the study is likely to make, for progress.
    pub(super) expected: u64,
    /// Name of the current step, for progress.
    step: String,
    progress: &'a mut ProgressFn<'a>,
}

impl<'a> Runs<'a> {
    pub(super) fn new(
        subject: &'a dyn PrecisionSubject,
        goal: &'a Goal,
        budget: u64,
        progress: &'a mut ProgressFn<'a>,
    ) -> Self {
        let programs = subject.programs();
        let places = places(&programs);
        Self {
            subject,
            goal,
            programs,
            places,
            budget,
            made: 0,
            expected: budget,
            values: BTreeMap::new(),
            step: String::new(),
            progress,
        }
    }

    /// Names the current step.
    pub(super) fn step(&mut self, step: impl Into<String>) {
        self.step = step.into();
    }

    /// Number of instructions that have a format.
    pub(super) fn count(&self) -> usize {
        self.places.len()
    }

    /// Assigns one format to all instructions.
    pub(super) fn uniform(&self, bits: FormatBits) -> Assignment {
        vec![Some(bits); self.count()]
    }

    /// Assigns a format to one instruction; all others are exact.
    pub(super) fn alone(&self, place: usize, bits: FormatBits) -> Assignment {
        (0..self.count()).map(|other| (other == place).then_some(bits)).collect()
    }

    /// Device of a run; `None` if the instructions of a program would have more formats than a device can hold.
    pub(super) fn device(&self, given: &Profile, assignment: &[Option<FormatBits>]) -> Option<Profile> {
        let mut formats = vec![BTreeMap::new(); self.programs.len()];
        for (place, bits) in self.places.iter().zip(assignment) {
            let format = bits.map(|bits| bits.format(given.rules.format));
            formats[place.program].extend(place.instructions.iter().filter_map(|at| Some((*at, format?))));
        }
        let mut device = exact(given, []);
        for (studied, formats) in self.programs.iter().zip(formats) {
            device.set_instruction_formats(studied.program, formats).then_some(())?;
        }
        Some(device)
    }

    /// Device with all instructions in one format, or exact.
    pub(super) fn uniform_device(&self, given: &Profile, bits: Option<FormatBits>) -> Profile {
        // A device can hold one format.
        self.device(given, &vec![bits; self.count()]).unwrap_or_else(|| given.clone())
    }

    /// Value of the goal's measure.
    pub(super) fn value(&mut self, assignment: &Assignment) -> Result<f64, RunError> {
        if let Some((value, _)) = self.values.get(assignment) {
            return Ok(*value);
        }
        let measured = match self.device(self.subject.profile(), assignment) {
            Some(device) => self.measure(&device)?,
            // A run without values meets no goal.
            None => Measured::default(),
        };
        let value = measured.value(&self.goal.measure);
        self.values.insert(assignment.clone(), (value, measured.worst));
        Ok(value)
    }

    /// Value of a run that was made, and the location of its largest error.
    pub(super) fn made_before(&self, assignment: &Assignment) -> Option<(f64, Option<String>)> {
        self.values.get(assignment).cloned()
    }

    /// Returns `true` if a run meets the goal.
    pub(super) fn meets(&mut self, assignment: &Assignment) -> Result<bool, RunError> {
        Ok(self.goal.met(self.value(assignment)?))
    }

    /// Measures the goal's measure on any device.
    pub(super) fn measure(&mut self, device: &Profile) -> Result<Measured, RunError> {
        if self.made >= self.budget {
            return Err(RunError::Budget);
        }
        (self.progress)(&self.step, self.made, self.expected.min(self.budget).max(self.made + 1));
        self.made += 1;
        Ok(self.subject.measure(device, Some(&self.goal.measure))?)
    }
}

/// Device with registers in single precision, rounding to nearest, and without formats of single instructions.
pub(super) fn exact<'p>(given: &Profile, programs: impl IntoIterator<Item = &'p Program>) -> Profile {
    let mut device = given.clone();
    let single = Format::FP32.with_specials(given.rules.format.specials);
    device.set_format(single).expect("single precision is a format of registers");
    for program in programs {
        device.set_instruction_formats(program, BTreeMap::new());
    }
    device
}
