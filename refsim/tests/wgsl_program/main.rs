//! Tests programs encoded as words for the interpreter on the GPU: the project's programs, fixtures and random ones.

mod cases;
#[path = "../common/environment.rs"]
mod environment;
#[path = "../../../tests/agree/generate/mod.rs"]
mod generate;
#[path = "../common/random.rs"]
mod random;
mod texts;
