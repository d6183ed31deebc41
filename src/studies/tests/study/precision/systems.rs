//! Each system as a subject.

use crossbar_studies::study::precision::PaperSystem;
use strum::IntoEnumIterator as _;

use super::*;

/// The exact run is exact; with all instructions in single precision it is unchanged; fewer bits change it.
#[test]
fn each_system_is_run_with_formats_of_its_instructions() {
    for system in PaperSystem::iter() {
        let device = Profile::named(system.card()).expect("a card");
        let subject = system.subject(device).unwrap_or_else(|e| panic!("{system:?}: {e}"));
        let uniform = |format: &str| {
            let mut device = exact_device(&*subject);
            for studied in subject.programs() {
                let formats = places(studied.program).map(|at| (at, format.parse().expect("a format"))).collect();
                assert!(device.set_instruction_formats(studied.program, formats));
            }
            device
        };
        let goal = subject.default_goal();
        let value = |device: &Profile| {
            let measured = subject.measure(device, Some(&goal.measure)).unwrap_or_else(|e| panic!("{system:?}: {e}"));
            measured.value(&goal.measure)
        };
        let right = value(&exact_device(&*subject));
        assert!(goal.met(right), "{system:?}: the exact run has {right}");
        assert_eq!(value(&uniform("fp32")), right, "{system:?}: single precision");
        let found = value(&uniform("e8m4"));
        assert!(!goal.met(found), "{system:?}: four bits give {found}");
    }
}
