//! Limits of the assembler.

/// Maximum length of a program text for [`assemble`](super::assemble), in bytes.
pub const MAX_TEXT: usize = 1 << 20;
/// Maximum total number of instructions, constants and declarations of a program.
pub const MAX_STATEMENTS: usize = 1 << 16;
/// Maximum number of syntax errors reported.
pub const MAX_ERRORS: usize = 1000;
/// Highest register number accepted; the checker enforces the version's limits.
pub const MAX_REGISTER: u16 = u16::MAX;
/// Maximum number of operands parsed for an instruction that its version lacks.
pub const MAX_OPERANDS: usize = 8;
/// Maximum length of a number, in characters.
pub const MAX_NUMBER: usize = 128;
