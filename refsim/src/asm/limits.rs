//! How much of a text is read.

/// The longest program text that [`assemble`](super::assemble) reads, in bytes.
pub const MAX_TEXT: usize = 1 << 20;
/// The most instructions, constants and declarations together that a program may have.
pub const MAX_STATEMENTS: usize = 1 << 16;
/// How many syntax errors are reported before the assembler gives up on a text.
pub const MAX_ERRORS: usize = 1000;
/// The highest register number that can be written; what a version really has is the checker's business.
pub const MAX_REGISTER: u16 = u16::MAX;
/// The most operands that an instruction foreign to its version may have.
pub const MAX_OPERANDS: usize = 8;
/// The longest number, in characters.
pub const MAX_NUMBER: usize = 128;
