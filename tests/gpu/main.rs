//! Tests that need a GPU adapter, in addition to the emulator's (`refsim/tests/gpu_*`, `wgsl_*`): bits must equal the
//! batch executor's. Without an adapter every test here is counted as ignored.
//!
//! `tests/agree` also draws one case in four on the adapter, if there is one.

#[path = "../../refsim/tests/common/adapter.rs"]
mod adapter;
#[path = "../laws/radiosity/all_pictures.rs"]
mod all_pictures;
mod display;
#[path = "../../refsim/tests/common/environment.rs"]
mod environment;
mod leaky_teapot;
#[path = "../cli/program.rs"]
mod program;
mod programs;
#[path = "../oracle/teapot_study.rs"]
mod teapot_study;

fn main() -> std::process::ExitCode {
    adapter::run(adapter::trials![
        on_adapter: display::the_same_pictures,
        leaky_teapot::the_same_study,
        programs::adapters_are_listed,
        programs::every_example_is_equal_down_to_its_instructions,
        programs::the_first_instruction_that_differs_is_named,
    ])
}
