//! All executors produce bit-identical results.
//!
//! A suite draws cases from a seed: a program, a device, a scene. The scalar executor and every other executor, at
//! every SIMD level and thread count, draw each case, and all targets, the depth buffer and every counter are compared.
//! A failing case is shrunk, and printed with the command that reproduces it: the suite's name, such as
//! `programs::ps_1_2::long_fixed::pipeline`, and `CROSSBAR_SEED`.
//! `CROSSBAR_FULL=1` runs ten times as many cases, `CROSSBAR_FUZZ=10m` runs for ten minutes.

#[path = "../../refsim/tests/common/adapter.rs"]
mod adapter;
mod agreement;
mod constants;
mod coverage;
mod dice;
#[path = "../../refsim/tests/common/environment.rs"]
mod environment;
mod executors;
mod files;
mod fuzz;
mod generate;
mod planted;
mod radiosity;
#[path = "../../refsim/tests/common/random.rs"]
mod random;
mod rules;
mod scene;
mod shapes;
mod shrink;
mod steps;
mod suite;
mod traces;

use libtest_mimic::Trial;

fn main() -> std::process::ExitCode {
    let of_suite = |suite: suite::Suite| {
        Trial::test(suite.name.clone(), move || {
            agreement::run(&suite);
            Ok(())
        })
    };
    let mut trials: Vec<Trial> = suite::all().into_iter().map(of_suite).collect();
    trials.extend(adapter::trials![
        on_host: constants::a_program_takes_other_constants_than_it_was_decoded_with,
        coverage::programs_reach_every_opcode_modifier_and_swizzle,
        coverage::scenes_reach_every_state,
        coverage::devices_reach_every_switch_value,
        coverage::suites_have_names_of_their_own,
        fuzz::fuzz,
        planted::a_planted_difference_is_cut_down,
        radiosity::every_pass_is_the_hosts,
        radiosity::full_blocks_are_the_hosts,
        steps::executors_run_out_of_steps_at_the_same_place,
        traces::the_trace_is_what_the_executors_draw,
    ]);
    adapter::run(trials)
}
