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

use crate::device::Rules;
use crate::exec::{CheckedProgram, PixelBindings, program};
pub(crate) use assembler::IN_OUT_ROWS;
pub use error::ProgramError;
pub use interpolate::Interpolation;
pub(crate) use interpolate::PLANES;
use lower::Lowered;
pub use microcode::Microcode;

/// Definition of `trace_put`, which records a word of a trace, for modules without traces.
pub const NO_TRACE: &str = "fn trace_put(at: u32, word: u32) {\n}\n";

/// The WGSL text of the virtual machine that executes [`Microcode`], `fn shade()`, with all parts.
pub fn machine() -> String {
    let names = (0..).zip(operations::NAMES);
    let constants = names.map(|(number, name)| format!("const {}: u32 = {number}u;\n", operations::constant(name)));
    constants.collect::<String>() + include_str!("program/vm.wgsl")
}

/// Returns `true` if shaders can run a pixel program: it has no flow control, and no vertex unit of a card computes it.
pub fn supports(checked: &CheckedProgram, rules: &Rules) -> bool {
    lower::supports(program(checked), rules)
}

/// A pixel program, ready to be encoded.
#[derive(Clone, Debug)]
pub struct PixelShader {
    lowered: Lowered,
}

impl PixelShader {
    /// Prepares a pixel program to run under `rules` with `bindings`. If `traced`, the results of every instruction are
    /// recorded ([`super::follow`]).
    ///
    /// # Errors
    /// [`ProgramError::Unsupported`] unless [`supports`].
    pub fn new(
        checked: &CheckedProgram,
        rules: &Rules,
        bindings: &PixelBindings<'_>,
        traced: bool,
    ) -> Result<Self, ProgramError> {
        Ok(Self { lowered: Lowered::pixel(program(checked), rules, bindings, traced)? })
    }

    /// Encodes the program for [`machine`], preceded by interpolation if given.
    ///
    /// # Errors
    /// [`ProgramError::TooLarge`].
    pub fn microcode(&self, interpolation: Option<&Interpolation>) -> Result<Microcode, ProgramError> {
        microcode::assemble(&self.lowered, interpolation)
    }
}
