//! Programs for GPUs. A checked program becomes words ([`Microcode`]) for one machine written in WGSL ([`machine`]), of
//! which a draw compiles the parts that it uses ([`super::parts`]).
//!
//! The machine is `fn shade()`, which works on the variables and rows of [`super::INTERFACE`]. Inputs are single
//! precision patterns with NaN canonical. The module also has the number library, the texture library, and what
//! [`NO_TRACE`] stands in for.

mod assembler;
mod interpolate;
mod lower;
mod microcode;
mod microcode_flow;
pub(super) mod operations;
mod trace;

use crate::device::Rules;
use crate::exec::lower::Formats;
use crate::exec::{CheckedProgram, PixelBindings, program};
pub(crate) use assembler::IN_OUT_ROWS;
pub use interpolate::Interpolation;
pub(crate) use interpolate::PLANES;
use lower::Lowered;
pub use microcode::{Microcode, ProgramError};
pub use trace::{TRACE_WORDS, trace_delivered, trace_steps};

/// The function that puts down what a followed lane does, in a module that follows none. Words are numbered from 0.
pub const NO_TRACE: &str = "fn trace_put(at: u32, word: u32) {\n}\n";

/// The machine that runs a [`Microcode`]: `fn shade()` in WGSL, with all its parts.
pub fn machine() -> String {
    let names = (0..).zip(operations::NAMES);
    let constants = names.map(|(number, name)| format!("const {}: u32 = {number}u;\n", operations::constant(name)));
    constants.collect::<String>() + include_str!("program/vm.wgsl")
}

/// A pixel program ready to be put into words.
#[derive(Clone, Debug)]
pub struct PixelShader {
    lowered: Lowered,
}

impl PixelShader {
    /// Prepares a program, which must be a pixel program, to run under `rules` with `bindings`; with `traced`, what
    /// each instruction writes in the followed lane is put down ([`trace_steps`]).
    pub fn new(checked: &CheckedProgram, rules: &Rules, bindings: &PixelBindings<'_>, traced: bool) -> Self {
        Self { lowered: Lowered::pixel(program(checked), rules, Formats::pixel(rules), bindings, traced) }
    }

    /// The words for [`machine`], which interpolate first unless inputs are given.
    ///
    /// # Errors
    /// [`ProgramError::TooLarge`].
    pub fn microcode(&self, interpolation: Option<&Interpolation>) -> Result<Microcode, ProgramError> {
        microcode::assemble(&self.lowered, interpolation)
    }
}
