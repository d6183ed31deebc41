//! Traces and differences for the page.

use crossbar_base::compare::{Compared, Number, TraceDifference, TraceStage, component};
use refsim::device::Profile;
use refsim::exec::FragmentFormats;
use refsim::isa::{Program, Register, RegisterFile};
use refsim::machine::FragmentTrace;
use refsim::num::{Flags, Format};
use refsim::output::FragmentFate;
use serde::Serialize;

/// A component with its value.
#[derive(Debug, Serialize)]
struct Written {
    name: String,
    value: String,
    bits: String,
}

#[derive(Debug, Serialize)]
struct ShownStep {
    /// Line of the text, from 1.
    line: usize,
    written: Vec<Written>,
    flags: Vec<String>,
}

#[derive(Debug, Serialize)]
pub(crate) struct ShownTrace {
    inputs: Vec<Written>,
    steps: Vec<ShownStep>,
    outcome: &'static str,
}

#[derive(Debug, Serialize)]
pub(crate) struct ShownDifference {
    stage: String,
    /// Line of the text, from 1; 0 if the difference has no instruction.
    line: usize,
    values: Vec<Compared>,
}

impl ShownTrace {
    pub(crate) fn new(program: &Program, profile: &Profile, text: &str, fragment: &FragmentTrace) -> Self {
        let formats = FragmentFormats::new(&profile.rules);
        let shown = |register: &Register, c: usize, format: Format, bits: u32| {
            let number = Number { format, bits };
            Written { name: component(program, register, c), value: number.decimal(), bits: number.hex() }
        };
        let delivered = fragment.shading.delivered.iter();
        let inputs = delivered
            .flat_map(|(register, value)| (0..4).map(|c| shown(register, c, formats.full, value[c])))
            .collect();
        let steps = fragment.shading.steps.iter().filter_map(|step| {
            let instruction = program.instructions.get(step.instruction)?;
            let register = instruction.destination?.register;
            let format = formats.of_file(register.file);
            // Predicates hold truth values.
            let truth = |bits: u32| if bits == 0 { 0 } else { format.one() };
            let is_truth = register.file == RegisterFile::Predicate;
            let value = step.value.map(|bits| if is_truth { truth(bits) } else { bits });
            let written = step.mask.components().map(|c| shown(&register, c, format, value[c])).collect();
            Some(ShownStep { line: line(text, instruction.span.start), written, flags: names(step.flags) })
        });
        let outcome = match fragment.shading.fate {
            FragmentFate::KilledByShader => "killed by the program",
            FragmentFate::AlphaFailed => "alpha test failed",
            FragmentFate::DepthFailed => "depth test failed",
            FragmentFate::Passed => "drawn",
            FragmentFate::OutsideTile => "outside the picture",
        };
        Self { inputs, steps: steps.collect(), outcome }
    }
}

impl ShownDifference {
    pub(crate) fn new(program: &Program, text: &str, difference: &TraceDifference) -> Self {
        let (stage, instruction) = match &difference.stage {
            TraceStage::Vertex { .. } => ("the vertices", None),
            TraceStage::Coverage { .. } => ("coverage", None),
            TraceStage::Input => ("the interpolated values", None),
            TraceStage::Delivered => ("an input register", None),
            TraceStage::Instruction { index } => ("the result of an instruction", Some(*index)),
            TraceStage::Mask { index, .. } => ("the components that an instruction writes", Some(*index)),
            TraceStage::Flow { left, right } => ("the next instruction", left.or(*right)),
            TraceStage::Output { instruction } => ("the program's output", *instruction),
            TraceStage::Test { .. } => ("a test", None),
            TraceStage::Merge => ("the stored color", None),
        };
        let at = instruction.and_then(|index| program.instructions.get(index));
        let line = at.map_or(0, |instruction| line(text, instruction.span.start));
        Self { stage: stage.to_owned(), line, values: difference.values.clone() }
    }
}

/// Line, from 1, of a byte of the text.
fn line(text: &str, byte: u32) -> usize {
    1 + text.bytes().take(byte as usize).filter(|&b| b == b'\n').count()
}

fn names(flags: Flags) -> Vec<String> {
    flags.iter_names().map(|(name, _)| name.to_lowercase().replace('_', " ")).collect()
}
