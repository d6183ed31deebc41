//! Programs for GPUs. A checked program becomes words for one machine written in WGSL ([`machine`]), whose arithmetic is
//! compiled once for all programs; or, where that is better ([`PixelShader::strategy`]), WGSL of its own.
//!
//! Both define `fn shade()`, which works on the variables of [`super::INTERFACE`]: `q_input`, `q_run`, `q_covered`,
//! `q_invocation`, `q_stride`, `q_code`, `q_trace` and `q_depth` are given, `q_color`, `q_depth`, `q_depth_is_main`, `q_killed`,
//! `q_executed` are left behind, reads are added to `q_fetched`. Inputs are single precision patterns with NaN canonical.
//! The module also has the number library, `texture_read`, and what [`NO_OUTPUT`] and [`NO_TRACE`] stand in for.

mod lower;
mod microcode;
mod microcode_flow;
mod operations;
mod text;
mod trace;

use crate::device::Rules;
use crate::exec::lower::Formats;
use crate::exec::wgsl::number::{NativeOperations, NumberMode};
use crate::exec::{CheckedProgram, Constants, PixelBindings, ResolvedConstants, program};
use crate::num::Format;
use lower::Lowered;
pub use microcode::Microcode;
pub use text::Unrolled;
use thiserror::Error;
pub use trace::{TRACE_WORDS, trace_delivered, trace_steps};

/// The function for vertex outputs in a module that has none.
pub const NO_OUTPUT: &str = "fn output_put(word: u32, row: vec4<u32>) {\n}\n";
/// The function that puts down what a followed lane does, in a module that follows none. Words are numbered from 0.
pub const NO_TRACE: &str = "fn trace_put(at: u32, word: u32) {\n}\n";

/// Words of a vertex that `vertex_main` leaves: 46 outputs in single precision (position, two colours, eight sets of
/// coordinates, fog, point size) and a count of instruction slots.
pub const VERTEX_WORDS: usize = 47;
/// Words of a vertex that `vertex_main` reads: `v0` to `v15`.
pub const ATTRIBUTE_WORDS: usize = 64;

/// Calls of integer arithmetic that a text may have to be worth compiling.
const SOFT_CALLS: usize = 24;
/// The same where all arithmetic is in integers, and the text would take the machine's place for little.
const SHORT_CALLS: usize = 6;
/// Texture reads, likewise.
const READS: usize = 2;

/// How a program is run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Strategy {
    /// On the [`machine`].
    Microcode,
    /// Written out as WGSL.
    Unrolled(Unrolled),
}

/// Why a program has no form for GPUs.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ProgramError {
    /// More values at a time, or more constants, than operands can name.
    #[error(
        "the program needs {slots} slots and {constants} constants, at most 32768 and 32512 can be named; use another executor"
    )]
    TooLarge {
        /// Values at a time.
        slots: usize,
        /// Constants.
        constants: usize,
    },
    /// The rules name a format that no executor computes in.
    #[error("no arithmetic for the register format {format}; choose another profile")]
    Format {
        /// The format.
        format: Format,
    },
}

/// The machine that runs a [`Microcode`]: `fn shade()` in WGSL, the same for all programs.
pub fn machine() -> &'static str {
    include_str!("program/vm.wgsl")
}

/// The start of a module that runs vertex programs: bindings and the entry point `vertex_main`, 64 invocations of 4
/// vertices a workgroup. Number library and [`machine`] complete it.
///
/// Bindings: 0 `draw`, words of the formats of [`super::number`], 8 each, vertex format first and single precision third, then in word 40 how many vertices; 1 attributes, [`ATTRIBUTE_WORDS`] a vertex; 2 the
/// program's words; 3 `scratch`, [`Microcode::slots`] times 64 rows a workgroup; 4 results, [`VERTEX_WORDS`] a vertex.
pub fn vertex_kernel() -> &'static str {
    include_str!("program/vertex.wgsl")
}

/// A pixel program ready to be put into words.
#[derive(Clone, Debug)]
pub struct PixelShader {
    lowered: Lowered,
}

impl PixelShader {
    /// Prepares a program, which must be a pixel program, to run under `rules` with `bindings`.
    ///
    /// # Errors
    /// [`ProgramError::Format`].
    pub fn new(checked: &CheckedProgram, rules: &Rules, bindings: &PixelBindings<'_>) -> Result<Self, ProgramError> {
        Self::prepare(checked, rules, bindings, false)
    }

    /// As [`Self::new`], and what each instruction writes in the followed lane is put down ([`trace_steps`]).
    ///
    /// # Errors
    /// [`ProgramError::Format`].
    pub fn traced(checked: &CheckedProgram, rules: &Rules, bindings: &PixelBindings<'_>) -> Result<Self, ProgramError> {
        Self::prepare(checked, rules, bindings, true)
    }

    fn prepare(
        checked: &CheckedProgram,
        rules: &Rules,
        bindings: &PixelBindings<'_>,
        traced: bool,
    ) -> Result<Self, ProgramError> {
        Ok(Self { lowered: Lowered::pixel(program(checked), rules, Formats::pixel(rules), bindings, traced) })
    }

    /// The words for [`machine`].
    ///
    /// # Errors
    /// [`ProgramError::TooLarge`].
    pub fn microcode(&self) -> Result<Microcode, ProgramError> {
        microcode::assemble(&self.lowered)
    }

    /// The program written out as WGSL; `None` if it has flow control. `native` counts in native mode only.
    pub fn unrolled(&self, mode: NumberMode, native: NativeOperations) -> Option<Unrolled> {
        text::unroll(&self.lowered, mode, native)
    }

    /// How the program is best run: written out where nearly all of it is the device's own arithmetic, or where it is
    /// short; on the machine otherwise. Compilers that put every function in place take minutes over hundreds of calls of integer
    /// arithmetic.
    pub fn strategy(&self, mode: NumberMode, native: NativeOperations) -> Strategy {
        let most = if mode == NumberMode::Native { SOFT_CALLS } else { SHORT_CALLS };
        match self.unrolled(mode, native) {
            Some(text) if text.soft_calls <= most && text.reads <= READS => Strategy::Unrolled(text),
            _ => Strategy::Microcode,
        }
    }
}

/// A vertex program ready to be put into words.
#[derive(Clone, Debug)]
pub struct VertexShader {
    lowered: Lowered,
}

impl VertexShader {
    /// Prepares a program, which must be a vertex program, to run under `rules`.
    ///
    /// # Errors
    /// [`ProgramError::Format`].
    pub fn new(checked: &CheckedProgram, rules: &Rules, constants: &Constants) -> Result<Self, ProgramError> {
        let formats = Formats::vertex(rules.vertex_format);
        let source = program(checked);
        let constants = ResolvedConstants::vertex(source, rules, constants);
        Ok(Self { lowered: Lowered::vertex(source, rules, formats, &constants) })
    }

    /// The words for [`machine`].
    ///
    /// # Errors
    /// [`ProgramError::TooLarge`].
    pub fn microcode(&self) -> Result<Microcode, ProgramError> {
        microcode::assemble(&self.lowered)
    }

    /// The program written out as WGSL; `None` if it has flow control. `native` counts in native mode only.
    pub fn unrolled(&self, mode: NumberMode, native: NativeOperations) -> Option<Unrolled> {
        text::unroll(&self.lowered, mode, native)
    }
}
