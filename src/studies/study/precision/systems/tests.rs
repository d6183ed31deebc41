//! Each system as a subject.

use refsim::machine::ExecutorKind;
use refsim::num::Format;
use strum::IntoEnumIterator as _;

use super::*;
use crate::study::precision::runs::exact;
use crate::study::precision::subject::places;

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
    }
}
