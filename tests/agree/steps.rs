//! Step budgets: executors agree on programs within a budget, and on the instruction that exceeds one.

use crate::environment::seeds;
use crate::executors::{EXECUTORS, Executor, REFERENCE};
use crate::scene::{Case, Outcome, Programs};
use crate::suite;
use refsim::machine::MachineError;

/// Prefixes of suites, most of them with flow control.
const SUITES: [&str; 7] = [
    "geometry::fine",
    "programs::ps_2_a::",
    "programs::vs_2_0::",
    "programs::ps_2_a::",
    "cards::nv30::ps_2_a",
    "programs::ps_1_4::",
    "programs::fp_1_0::",
];
/// More than the steps of any random program.
const PLENTY: u32 = 1 << 16;

fn draw(case: &mut Case, programs: &Programs, executor: &Executor, budget: u32) -> Result<Outcome, MachineError> {
    case.scene.profile.limits.set_step_budget(budget);
    case.scene.draw(executor, programs)
}

/// The smallest budget with which the reference draws.
fn least(case: &mut Case, programs: &Programs) -> u32 {
    let (mut fails, mut fits) = (0, PLENTY);
    while fits - fails > 1 {
        let middle = fails + (fits - fails) / 2;
        match draw(case, programs, &REFERENCE, middle) {
            Ok(_) => fits = middle,
            Err(MachineError::StepBudget { .. }) => fails = middle,
            Err(error) => panic!("{error}"),
        }
    }
    fits
}

pub(crate) fn executors_run_out_of_steps_at_the_same_place() {
    let (seeds, mut failures) = (seeds(12, 100), 0);
    for seed in seeds.clone() {
        let prefix = SUITES[seed as usize % SUITES.len()];
        let mut case = suite::small_case(|name| name.starts_with(prefix), seed, 2000, 21);
        let programs = case.build().unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let least = least(&mut case, &programs);
        for budget in [least, least - 1, least / 2, least / 7 + 1] {
            if budget == 0 {
                continue;
            }
            let expected = draw(&mut case, &programs, &REFERENCE, budget);
            assert_eq!(expected.is_ok(), budget >= least, "seed {seed}: a larger budget fails");
            failures += usize::from(expected.is_err());
            for executor in EXECUTORS.iter().filter(|e| seed.is_multiple_of(e.every)) {
                let found = draw(&mut case, &programs, executor, budget);
                let place = format!("seed {seed}, {}, budget {budget}\n{}", executor.name, case.pixel.join("\n"));
                match (&expected, &found) {
                    (Ok(expected), Ok(found)) => {
                        assert_eq!(expected.difference(found, &executor.name), None, "{place}");
                    }
                    _ => assert_eq!(expected.as_ref().err(), found.as_ref().err(), "{place}"),
                }
            }
        }
    }
    assert!(seeds.count() == 1 || failures > 15, "{failures}");
}
