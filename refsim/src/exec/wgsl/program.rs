//! Pixel programs on GPUs. A checked program is encoded as words ([`Microcode`]) for a virtual machine written in WGSL
//! ([`machine`]); a draw compiles only the parts that it uses ([`super::parts`]).
//!
//! The machine is `fn shade()`, which operates on the variables and rows of [`super::INTERFACE`]. Inputs are
//! single-precision patterns with canonical NaN. The module also needs the number library, the texture library, and
//! either a trace function or [`NO_TRACE`].

mod assembler;
mod error;
mod interpolate;
mod lower;
mod microcode;
pub(super) mod operations;

pub(crate) use assembler::IN_OUT_ROWS;
pub use error::ProgramError;
pub use interpolate::Interpolation;
pub(crate) use interpolate::PLANES;
pub use lower::{PixelShader, supports};
pub use microcode::Microcode;

/// Definition of `trace_put`, which records a word of a trace, for modules without traces.
pub const NO_TRACE: &str = "fn trace_put(at: u32, word: u32) {\n}\n";

/// The WGSL text of the virtual machine that executes [`Microcode`], `fn shade()`, with all parts.
pub fn machine() -> String {
    let names = (0..).zip(operations::NAMES);
    let constants = names.map(|(number, name)| format!("const {}: u32 = {number}u;\n", operations::constant(name)));
    constants.collect::<String>() + include_str!("program/vm.wgsl")
}
