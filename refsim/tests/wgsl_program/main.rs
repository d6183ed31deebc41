//! Programs as words of the GPU's machine: the project's programs, fixtures and random ones.

mod cases;
#[path = "../common/environment.rs"]
mod environment;
#[path = "../../../tests/agree/generate/mod.rs"]
mod generate;
#[path = "../common/random.rs"]
mod random;
mod texts;
