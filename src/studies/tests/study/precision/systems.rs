//! Each system as a subject.

use crossbar_studies::study::precision::{PaperSystem, PrecisionSubject};
use refsim::device::{Profile, takes_format};
use refsim::isa::Program;
use refsim::num::Format;
use strum::IntoEnumIterator as _;

/// Instruction of a subject, by the indices of program and instruction.
#[derive(Clone, Copy, Debug)]
struct Place {
    program: usize,
    at: usize,
}

/// Instructions that can have their own format.
fn places(subject: &dyn PrecisionSubject) -> Vec<Place> {
    let of = |(program, studied): (usize, &Program)| {
        let takes = |at: &usize| takes_format(&studied.instructions[*at]);
        (0..studied.instructions.len()).filter(takes).map(|at| Place { program, at }).collect::<Vec<_>>()
    };
    subject.programs().iter().map(|studied| studied.program).enumerate().flat_map(of).collect()
}

/// Device of the exact run: registers of single precision.
fn exact_device(subject: &dyn PrecisionSubject) -> Profile {
    let mut device = subject.profile().clone();
    let single = Format::FP32.with_specials(device.rules.format.specials);
    device.set_format(single).expect("single precision is a format of registers");
    device
}

/// The exact run is exact; with all instructions in single precision it is unchanged; fewer bits change it.
#[test]
fn each_system_is_run_with_formats_of_its_instructions() {
    for system in PaperSystem::iter() {
        let device = Profile::named(system.card()).expect("a card");
        let subject = system.subject(device).unwrap_or_else(|e| panic!("{system:?}: {e}"));
        let (programs, places, exact) = (subject.programs(), places(&*subject), exact_device(&*subject));
        let uniform = |format: &str| {
            let format: Format = format.parse().expect("a format");
            let mut device = exact.clone();
            for place in &places {
                assert!(device.set_instruction_format(programs[place.program].program, place.at, Some(format)));
            }
            device
        };
        let goal = subject.default_goal();
        let value = |device: &Profile| {
            let measured = subject.measure(device, Some(&goal.measure)).unwrap_or_else(|e| panic!("{system:?}: {e}"));
            measured.value(&goal.measure)
        };
        let right = value(&exact);
        assert!(goal.met(right), "{system:?}: the exact run has {right}");
        assert_eq!(value(&uniform("fp32")), right, "{system:?}: single precision");
        let found = value(&uniform("e8m4"));
        assert!(!goal.met(found), "{system:?}: four bits give {found}");
    }
}
