//! Tests of shader text and its rules: assembler, printer and checker for each version, and OpenGL's
//! fragment programs.

mod asm;
mod asm_laws;
mod check;
mod check_laws;
#[path = "../common/environment.rs"]
mod environment;
mod fragment_program;
#[path = "../../../tests/agree/generate/mod.rs"]
mod generate;
mod isa_table;
#[path = "../common/random.rs"]
mod random;
#[path = "../common/running.rs"]
mod running;
#[path = "../common/spacing.rs"]
mod spacing;
