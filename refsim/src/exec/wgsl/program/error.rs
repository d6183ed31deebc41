//! Programs that shaders cannot run.

use thiserror::Error;

/// Error of encoding a program for GPUs.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ProgramError {
    /// More live values or constants than operands can address.
    #[error(
        "the program needs {slots} slots and {constants} constants, shaders have at most 32768 and 32256; use another executor"
    )]
    TooLarge {
        /// Number of slots for live values.
        slots: usize,
        /// Number of constants.
        constants: usize,
    },
    /// The program has flow control, or a format in which a vertex unit of a card computes.
    #[error(
        "the program has flow control, or computes in a card's vertex unit, which shaders lack; use another executor"
    )]
    Unsupported,
    /// More number formats of instructions, storages, sums and products than the shader's table holds.
    #[error("the program has {formats} number formats, the table in shaders has at most {most}; use another executor")]
    TooManyFormats {
        /// Number of formats.
        formats: usize,
        /// Maximum number of formats.
        most: usize,
    },
}
