//! Interface to the subject of a precision study.

use std::collections::BTreeMap;

use refsim::device::{Profile, takes_format};
use refsim::isa::{Instruction, Opcode, Program};

use super::goal::Goal;
use crate::picture::RgbImage;
use crate::shader::ShaderText;
use crate::study::StudyError;

/// Pixel program whose instructions get formats of their own.
#[derive(Clone, Copy, Debug)]
pub struct StudiedProgram<'a> {
    /// The program, as checked for the device.
    pub program: &'a Program,
    /// Its text.
    pub text: &'a ShaderText,
}

/// Measure of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrecisionMeasure {
    /// Name in goals.
    pub name: &'static str,
    /// Meaning, with the unit.
    pub meaning: &'static str,
}

/// Measured values of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// Values by the names of their measures.
    pub values: Vec<(&'static str, f64)>,
    /// Location of the largest error, with the found and the expected value; `None` if nothing differs.
    pub worst: Option<String>,
    /// Picture of the result.
    pub picture: Option<RgbImage>,
}

impl Measured {
    /// Value of a measure; NaN, which meets no goal, if it was not measured.
    pub fn value(&self, measure: &str) -> f64 {
        self.values.iter().find(|(name, _)| *name == measure).map_or(f64::NAN, |(_, value)| *value)
    }
}

/// Pixel programs with their input, run on a device repeatedly in different number formats.
///
/// Every run is compared with the same reference, which does not depend on the device of the run. The same device gives
/// the same values.
pub trait PrecisionSubject {
    /// Title.
    fn title(&self) -> String;

    /// Unchanged device. The exact run is on this device with single-precision registers.
    fn profile(&self) -> &Profile;

    /// Pixel programs, each once.
    fn programs(&self) -> Vec<StudiedProgram<'_>>;

    /// Measures, in the order of tables.
    fn measures(&self) -> &[PrecisionMeasure];

    /// Goal if none is given.
    fn default_goal(&self) -> Goal;

    /// Runs on a device and measures: one measure, or all of them with the picture if `wanted` is `None`. Fails if the
    /// device cannot run the programs.
    fn measure(&self, profile: &Profile, wanted: Option<&str>) -> Result<Measured, StudyError>;

    /// Runs another text in place of the only pixel program on the device of the exact run, and measures; `None` if the
    /// subject has several programs.
    ///
    /// # Errors
    /// If the text is not a program that the device can run.
    fn measure_text(&self, text: &ShaderText, wanted: &str) -> Result<Option<Measured>, StudyError> {
        let _ = (text, wanted);
        Ok(None)
    }

    /// Returns `true` if the exact run on this device, which differs in a switch, draws with pixel programs that are
    /// not the subject's. Fails if the device cannot run the programs.
    fn chooses_other_programs(&self, profile: &Profile) -> Result<bool, StudyError> {
        let _ = profile;
        Ok(false)
    }

    /// Measures on held-back input; `None` without such input. Fails if the device cannot run the programs.
    fn held_back(&self, profile: &Profile) -> Result<Option<Measured>, StudyError> {
        let _ = profile;
        Ok(None)
    }

    /// Sentences about the subject for the page.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }
}

/// Minimum number of instructions with the same text that count as an unrolled loop and share a format.
const UNROLLED: usize = 8;

/// Instruction of a subject, by the indices of program and instruction. For an expression of WGSL or an unrolled loop:
/// all instructions of its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct InstructionPlace {
    pub(super) program: usize,
    /// In ascending order; at least one.
    pub(super) instructions: Vec<usize>,
}

/// Instructions that can have their own format, in the order of the texts.
pub(super) fn places(programs: &[StudiedProgram<'_>]) -> Vec<InstructionPlace> {
    programs.iter().enumerate().flat_map(|(program, studied)| places_of(program, *studied)).collect()
}

fn places_of(program: usize, StudiedProgram { program: studied, text }: StudiedProgram<'_>) -> Vec<InstructionPlace> {
    // Moves in a translated shader only gather components; they are not operations of the source text.
    let is_move = |instruction: &Instruction| {
        text.is_wgsl() && instruction.opcode == Opcode::Mov && instruction.fragment.precision.is_none()
    };
    // By text, and by span: an expression of a translated shader may be several instructions.
    let mut by_text: BTreeMap<String, BTreeMap<[u32; 2], Vec<usize>>> = BTreeMap::new();
    for (at, instruction) in studied.instructions.iter().enumerate() {
        if takes_format(instruction) && !is_move(instruction) {
            let (text, span) = (studied.instruction_text(at), instruction.span);
            // Instructions that tests build have no span.
            let place = if text.is_some() { [span.start, span.end] } else { [0, at as u32] };
            by_text.entry(text.unwrap_or_default()).or_default().entry(place).or_default().push(at);
        }
    }
    let split = |same: BTreeMap<[u32; 2], Vec<usize>>| -> Vec<Vec<usize>> {
        match same.len() >= UNROLLED {
            true => vec![same.into_values().flatten().collect()],
            false => same.into_values().collect(),
        }
    };
    let place = |mut instructions: Vec<usize>| {
        instructions.sort_unstable();
        InstructionPlace { program, instructions }
    };
    let mut places: Vec<InstructionPlace> = by_text.into_values().flat_map(split).map(place).collect();
    places.sort_by_key(|place| place.instructions[0]);
    places
}
