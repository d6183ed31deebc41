//! Each system as a subject.

use refsim::isa::{Opcode, OpcodeClass, Program};
use refsim::machine::ExecutorKind;
use refsim::num::Format;
use strum::IntoEnumIterator as _;

use super::*;
use crate::study::precision::bits::FormatBits;
use crate::study::precision::runs::exact;
use crate::study::precision::subject::{
    FragmentResults, InstructionPlace, Measured, PixelSteps, RefutingDevices, RoundedInstruction, WorstPlace, places,
};
use crate::study::precision::ulps::{errors_of, local_error};

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
        check_samples(&*subject, &exact, &places);
        let measured = subject.measure(&exact, ExecutorKind::Batch, None).expect("it runs");
        for (program, studied) in programs.iter().enumerate() {
            let mut own = places.iter().filter(|place| place.program == program).rev();
            let traced = own.any(|place| is_traced(&*subject, (&exact, &measured), studied.program, place));
            // A program of one move fills the depth buffer alone.
            let fills_depth = studied.program.instructions.len() == 1;
            assert!(traced || fills_depth, "{system:?}: no instruction of program {program} changes anything");
        }
    }
}

/// Instructions of a system that are sampled, at most.
const SAMPLED: usize = 24;

/// Each instruction is sampled in the same fragments in the exact run and when it is rounded. Single precision rounds
/// nothing, four bits do, and moves by half a unit at most.
fn check_samples(subject: &dyn PrecisionSubject, exact: &Profile, places: &[InstructionPlace]) {
    let title = subject.title();
    let programs = subject.programs();
    let places: Vec<&InstructionPlace> = places.iter().step_by(places.len().div_ceil(SAMPLED)).collect();
    let sampled = |format: &str| {
        let format: Format = format.parse().expect("a format");
        let of =
            |place: &&InstructionPlace| RoundedInstruction { program: place.program, instruction: place.at, format };
        let rounded: Vec<_> = places.iter().map(of).collect();
        subject.results(exact, &rounded).unwrap_or_else(|e| panic!("{title}: {e}"))
    };
    let [single, coarse] = [sampled("fp32"), sampled("e8m4")];
    assert!(single.exact == coarse.exact && coarse.rounded.len() == places.len(), "{title}");
    let is_move =
        |place: &InstructionPlace| programs[place.program].program.instructions[place.at].opcode == Opcode::Mov;
    let (mut executed, mut off) = (0, 0);
    for ((place, single_results), coarse_results) in places.into_iter().zip(&single.rounded).zip(&coarse.rounded) {
        let Some(right) = single.exact[place.program].get(&place.at) else { continue };
        assert!(same_bits(right, single_results), "{title}, {place:?}: single precision");
        assert!(right.keys().eq(coarse_results.keys()), "{title}, {place:?}: other fragments");
        let error = local_error(errors_of(FormatBits::float(8, 4), right, coarse_results)).expect("results");
        assert!(!is_move(place) || error.largest <= 0.5, "{title}, {place:?}: {error:?}");
        executed += 1;
        off += usize::from(error.largest > 0.0);
    }
    assert!(10 * executed >= 9 * coarse.rounded.len(), "{title}: {executed} are sampled");
    assert!(2 * off > executed, "{title}: {off} of {executed} are rounded");
}

fn same_bits(a: &FragmentResults, b: &FragmentResults) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|((at, a), (other, b))| at == other && a.to_bits() == b.to_bits())
}

/// Follows a pixel with one instruction in a coarse format: what differs first is that instruction, or a texture with
/// results of it. Returns `false` if the instruction changes nothing.
fn is_traced(
    subject: &dyn PrecisionSubject,
    (exact, right): (&Profile, &Measured),
    program: &Program,
    place: &InstructionPlace,
) -> bool {
    let mut less = exact.clone();
    let format: Format = "e8m2".parse().expect("a format");
    assert!(place.instructions().all(|at| less.set_instruction_format(program, at, Some(format))));
    let Measured { values, worst, .. } = subject.measure(&less, ExecutorKind::Batch, None).expect("it runs");
    let Some(WorstPlace { pixel: Some(worst), .. }) = worst.filter(|_| values != right.values) else {
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
