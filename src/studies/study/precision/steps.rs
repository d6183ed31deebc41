//! Results of the instructions of traced fragments.

use refsim::device::Profile;
use refsim::exec::FragmentFormats;
use refsim::isa::Program;
use refsim::machine::FragmentTrace;
use refsim::num::to_f64;

use super::subject::{InstructionResults, RoundedInstruction};

/// Device of the exact run, with a format for one instruction.
pub(super) fn with_rounded(exact: &Profile, program: &Program, rounded: RoundedInstruction) -> Profile {
    let mut device = exact.clone();
    // Always succeeds: searches use register formats, and a device can hold one format.
    device.set_instruction_format(program, rounded.instruction, Some(rounded.format));
    device
}

/// First result of each wanted instruction in each fragment. Fragments are numbered from `first`.
pub(super) fn first_results<'t>(
    profile: &Profile,
    program: &Program,
    (first, fragments): (u32, impl IntoIterator<Item = &'t FragmentTrace>),
    is_wanted: impl Fn(usize) -> bool,
) -> InstructionResults {
    let formats = FragmentFormats::new(&profile.rules);
    let mut results = InstructionResults::new();
    for (number, fragment) in (first..).zip(fragments) {
        for step in fragment.shading.steps.iter().filter(|step| is_wanted(step.instruction)) {
            let instruction = program.instructions.get(step.instruction);
            let Some(destination) = instruction.and_then(|instruction| instruction.destination) else { continue };
            let format = formats.of_file(destination.register.file);
            for component in (0..4_u8).filter(|&component| step.mask.contains(usize::from(component))) {
                let of_instruction = results.entry(step.instruction).or_default();
                let value = to_f64(&format, step.value[usize::from(component)]);
                of_instruction.entry((number, component)).or_insert(value);
            }
        }
    }
    results
}
