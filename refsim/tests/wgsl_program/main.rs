//! Programs for GPUs: whatever the project, the fixtures and chance have to offer becomes valid WGSL and words, and on
//! an adapter computes what the scalar executor computes.

#[path = "../../../tests/agree/generate/mod.rs"]
#[allow(dead_code, reason = "shared with the agreement suites")]
mod generate;
#[path = "../../../tests/agree/random.rs"]
#[allow(dead_code, reason = "shared with the agreement suites")]
mod random;

mod cases;
mod modules;
#[cfg(feature = "wgpu")]
#[expect(clippy::print_stdout, reason = "tests say what took how long, and that they saw no adapter")]
mod runs;
mod texts;
