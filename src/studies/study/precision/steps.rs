//! Results of the instructions of traced fragments.

use refsim::device::Profile;
use refsim::exec::FragmentFormats;
use refsim::isa::Program;
use refsim::machine::FragmentTrace;
use refsim::num::to_f64;

use super::subject::StepResult;

/// Results of the instructions of a fragment that write registers, component by component; `program` has its index
/// among the subject's, `fragment` its number within the trace.
pub(super) fn step_results(
    profile: &Profile,
    (index, program): (usize, &Program),
    (number, fragment): (u32, &FragmentTrace),
) -> Vec<StepResult> {
    let formats = FragmentFormats::new(&profile.rules);
    let mut results = Vec::new();
    for step in &fragment.shading.steps {
        let instruction = program.instructions.get(step.instruction);
        let Some(destination) = instruction.and_then(|instruction| instruction.destination) else { continue };
        let format = formats.of_file(destination.register.file);
        let components = (0..4_u8).filter(|&component| step.mask.contains(usize::from(component)));
        results.extend(components.map(|component| StepResult {
            fragment: number,
            program: index,
            instruction: step.instruction,
            component,
            value: to_f64(&format, step.value[usize::from(component)]),
        }));
    }
    results
}
