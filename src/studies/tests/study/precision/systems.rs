//! Each system as a subject.

use std::collections::BTreeSet;

use crossbar_base::elementary::pow;
use crossbar_studies::study::precision::{FragmentResults, PaperSystem, PrecisionSubject, RoundedInstruction, spread};
use refsim::device::{Profile, takes_format};
use refsim::isa::{Opcode, Program};
use refsim::machine::ExecutorKind;
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

/// The exact run is exact; with all instructions in single precision it is unchanged; fewer bits change it; both
/// executors agree.
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
    }
}

/// Maximum number of instructions of a system that are sampled.
const SAMPLED: usize = 24;

/// Each instruction is sampled in the same fragments in the exact run and rounded. Single precision rounds nothing;
/// four bits do, by at most half a unit.
fn check_samples(subject: &dyn PrecisionSubject, exact: &Profile, places: &[Place]) {
    let title = subject.title();
    let programs = subject.programs();
    let places: Vec<Place> = places.iter().copied().step_by(places.len().div_ceil(SAMPLED)).collect();
    let sampled = |format: &str| {
        let format: Format = format.parse().expect("a format");
        let of = |place: &Place| RoundedInstruction { program: place.program, instruction: place.at, format };
        let rounded: Vec<_> = places.iter().map(of).collect();
        subject.results(exact, &rounded).unwrap_or_else(|e| panic!("{title}: {e}"))
    };
    let [single, coarse] = [sampled("fp32"), sampled("e8m4")];
    assert!(single.exact == coarse.exact && coarse.rounded.len() == places.len(), "{title}");
    let is_move = |place: Place| programs[place.program].program.instructions[place.at].opcode == Opcode::Mov;
    let (mut executed, mut off) = (0, 0);
    for ((place, single_results), coarse_results) in places.into_iter().zip(&single.rounded).zip(&coarse.rounded) {
        let Some(right) = single.exact[place.program].get(&place.at) else { continue };
        assert!(same_bits(right, single_results), "{title}, {place:?}: single precision");
        assert!(right.keys().eq(coarse_results.keys()), "{title}, {place:?}: other fragments");
        let error = largest_error(right, coarse_results);
        assert!(!is_move(place) || error <= 0.5, "{title}, {place:?}: {error}");
        executed += 1;
        off += usize::from(error > 0.0);
    }
    assert!(10 * executed >= 9 * coarse.rounded.len(), "{title}: {executed} are sampled");
    assert!(2 * off > executed, "{title}: {off} of {executed} are rounded");
}

/// Largest error in units in the last place of e8m4; infinite if only one of two results is finite.
fn largest_error(exact: &FragmentResults, rounded: &FragmentResults) -> f64 {
    let error = |(exact, rounded): (&f64, &f64)| {
        if exact == rounded || (exact.is_nan() && rounded.is_nan()) {
            return 0.0;
        }
        let exponent = ((exact.to_bits() >> 52) & 0x7ff) as i32 - 1023;
        let error = (exact - rounded).abs() / pow(2.0, f64::from(exponent.max(-126) - 4));
        if error.is_nan() { f64::INFINITY } else { error }
    };
    exact.values().zip(rounded.values()).map(error).fold(0.0, f64::max)
}

fn same_bits(a: &FragmentResults, b: &FragmentResults) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|((at, a), (other, b))| at == other && a.to_bits() == b.to_bits())
}

#[test]
fn each_number_is_taken_once() {
    for count in (0..200).chain([4096, 5000]) {
        let mut all: Vec<u32> = spread(count).collect();
        all.sort_unstable();
        assert_eq!(all, (0..count).collect::<Vec<_>>());
    }
    // The first sixteen of 4,096 numbers reach every eighth of the range.
    let eighths: BTreeSet<u32> = spread(4096).take(16).map(|at| at / 512).collect();
    assert_eq!(eighths.len(), 8);
}
