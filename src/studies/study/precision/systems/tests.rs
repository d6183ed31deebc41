//! Each system as a subject.

use refsim::isa::{OpcodeClass, Program};
use refsim::machine::ExecutorKind;
use refsim::num::Format;
use strum::IntoEnumIterator as _;

use super::*;
use crate::study::precision::runs::exact;
use crate::study::precision::subject::{InstructionPlace, Measured, PixelSteps, RefutingDevices, WorstPlace, places};

fn device(system: PaperSystem) -> Profile {
    Profile::named(system.card()).expect("a card")
}

/// The exact run is exact; all instructions in single precision are the exact run; fewer bits are not; both executors
/// agree.
#[test]
fn each_system_is_run_with_formats_of_its_instructions() {
    for system in PaperSystem::iter() {
        let subject = system.subject(device(system)).unwrap_or_else(|e| panic!("{system:?}: {e}"));
        let programs = subject.programs();
        let places = places(&programs);
        let exact = exact(subject.profile(), programs.iter().map(|studied| studied.program));
        let uniform = |format: &str| {
            let format: Format = format.parse().expect("a format");
            let mut device = exact.clone();
            for place in &places {
                assert!(device.set_instruction_format(programs[place.program].program, place.at, Some(format)));
            }
            device
        };
        let goal = subject.default_goal();
        let value = |device: &Profile, kind| {
            let measured =
                subject.measure(device, kind, Some(&goal.measure)).unwrap_or_else(|e| panic!("{system:?}: {e}"));
            measured.value(&goal.measure)
        };
        let right = value(&exact, ExecutorKind::Batch);
        assert!(goal.met(right), "{system:?}: the exact run has {right}");
        assert_eq!(value(&uniform("fp32"), ExecutorKind::Batch), right, "{system:?}: single precision");
        let coarse = uniform("e8m4");
        let found = value(&coarse, ExecutorKind::Batch);
        assert!(!goal.met(found), "{system:?}: four bits give {found}");
        assert_eq!(value(&coarse, ExecutorKind::Scalar), found, "{system:?}: executors");
        for (program, studied) in programs.iter().enumerate() {
            let mut own = places.iter().filter(|place| place.program == program).rev();
            let traced = own.any(|place| is_traced(&*subject, &exact, studied.program, place));
            // A program of one move fills the depth buffer alone.
            let fills_depth = studied.program.instructions.len() == 1;
            assert!(traced || fills_depth, "{system:?}: no instruction of program {program} changes anything");
        }
    }
}

/// Follows a pixel with one instruction in a coarse format: what differs first is that instruction, or a texture with
/// results of it. Returns `false` if the instruction changes nothing.
fn is_traced(subject: &dyn PrecisionSubject, exact: &Profile, program: &Program, place: &InstructionPlace) -> bool {
    let mut less = exact.clone();
    let format: Format = "e8m2".parse().expect("a format");
    assert!(place.instructions().all(|at| less.set_instruction_format(program, at, Some(format))));
    let measured = |device: &Profile| subject.measure(device, ExecutorKind::Batch, None).expect("it runs");
    let Measured { values, worst, .. } = measured(&less);
    let Some(WorstPlace { pixel: Some(worst), .. }) = worst.filter(|_| values != measured(exact).values) else {
        return false;
    };
    let devices = RefutingDevices { exact, mixed: exact, less: &less, program: place.program };
    let PixelSteps { steps: [right, mixed, less], .. } =
        subject.steps(devices, worst).expect("it runs").expect("systems have traces");
    let title = subject.title();
    assert!(!right.is_empty() && right == mixed, "{title}: the same device has the same steps");
    assert!(less.iter().any(|step| step.program == place.program), "{title}: the program is not followed");
    let first = mixed.iter().zip(&less).find(|(mixed, less)| mixed != less);
    let (first, _) = first.unwrap_or_else(|| panic!("{title}, {place:?}: nothing differs"));
    let is_refuted = first.program == place.program && place.instructions().any(|at| at == first.instruction);
    let texts = subject.programs();
    let instruction = &texts[first.program].program.instructions[first.instruction];
    let is_read = instruction.opcode.info().class == OpcodeClass::Texture;
    assert!(is_refuted || is_read, "{title}, {place:?}: {first:?} differs first");
    true
}
