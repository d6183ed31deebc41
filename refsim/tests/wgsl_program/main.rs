//! Programs on GPUs: the project's programs, fixtures and random ones are encoded as valid WGSL and words, and on an
//! adapter give the scalar executor's results.

#[path = "../common/adapter.rs"]
mod adapter;
mod cases;
#[path = "../common/environment.rs"]
mod environment;
#[path = "../../../tests/agree/generate/mod.rs"]
mod generate;
mod modules;
#[path = "../common/random.rs"]
mod random;
#[cfg(feature = "wgpu")]
mod runs;
mod texts;

fn main() -> std::process::ExitCode {
    let mut trials = adapter::trials![
        on_host: texts::the_modules_are_valid,
        texts::the_validator_says_no_to_something,
        texts::files_become_sound_words,
        texts::random_programs_become_sound_words,
    ];
    #[cfg(feature = "wgpu")]
    trials.extend(adapter::trials![
        on_adapter: runs::the_machine_runs_random_programs,
        runs::the_machine_tells_what_instructions_write,
        runs::the_machine_reads_textures,
    ]);
    adapter::run(trials)
}
