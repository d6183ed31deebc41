//! One vertex program with several sets of constants in turn: decoding for the first must not affect the others.

use crate::agreement::compare;
use crate::random::Random;
use crate::suite;

/// Cases per suite, and sets of constants per case.
const SEEDS: u64 = 3;
const SETS: usize = 4;
/// The turn of executors that draw every case.
const QUICK: u64 = 1;

pub(crate) fn a_program_takes_other_constants_than_it_was_decoded_with() {
    let mut compared = 0;
    for suite in suite::all().iter().filter(|suite| suite.name.contains("vs_")) {
        for seed in 0..SEEDS {
            let mut case = suite.case(seed);
            let mut random = Random::named(&suite.name, seed);
            for set in 0..SETS {
                let (_, differences) = compare(&case, QUICK).expect("a legal case");
                let what = differences.first().map(|difference| difference.what.as_str());
                assert_eq!(what, None, "{}, seed {seed}, constants {set}:\n{:?}", suite.name, case.vertex);
                for constant in &mut case.scene.vertex_constants.float {
                    *constant = random.vector();
                }
                compared += usize::from(!case.scene.vertex_constants.float.is_empty());
            }
        }
    }
    assert!(compared > 100, "{compared} draws have constants of their own");
}
