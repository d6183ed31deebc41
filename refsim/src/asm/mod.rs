//! Assembly languages of the period: parsing text into a [`Program`], and printing it.
//!
//! [`assemble`] accepts what programmers of 2001 to 2004 wrote: any case, optional commas, `//`, `;` and `/* */`
//! comments, DirectX 8 spellings (`ps.1.4`), selectors before or after modifiers. It checks *syntax* only: a program
//! with `r99` or forty instructions too many assembles, and the checker rejects it. An unknown word, a malformed
//! operand or a wrong operand count is a syntax error; one call finds all of them.
//!
//! [`print()`] writes a canonical form of any program, such that `assemble(&print(&p)) == Ok(p)`.
//!
//! OpenGL's fragment programs (`!!FP1.0`, `!!ARBfp1.0`) have their own parsers (`gl`), which also return a [`Program`].
//!
//! There are two extensions of the period's syntax: `def` accepts `0x` and eight hexadecimal digits as the bits of a
//! float (so that infinities and NaNs can be printed), and a constant's value may end in `f`. Source: Direct3D 9
//! "Assembly Shader Syntax" pages, DirectX 8.1 "Pixel Shader Assembler Reference".

mod cursor;
mod declare;
mod error;
mod gl;
mod letters;
mod lexer;
mod limits;
mod list;
mod number;
mod operand;
mod parser;
mod print;
mod word;

pub use error::{AssembleErrors, ErrorKind, SyntaxError};
pub use limits::{MAX_ERRORS, MAX_NUMBER, MAX_OPERANDS, MAX_REGISTER, MAX_STATEMENTS, MAX_TEXT};

use std::collections::BTreeMap;

use crate::isa::{Program, ProgramText, Register, Span, Version};

/// Parses a program.
///
/// ```
/// let program = refsim::asm::assemble("ps.1.1\ntex t0 // the texture\nMUL_x2 r0 t0, v0\n").expect("a program");
/// assert_eq!(refsim::asm::print(&program), "ps_1_1\ntex t0\nmul_x2 r0, t0, v0\n");
///
/// let errors = refsim::asm::assemble("ps_1_1\nmull r0, t0\nadd r0\n").expect_err("two lines are wrong");
/// assert_eq!(errors.errors.len(), 2);
/// assert!(errors.to_string().contains("line 2, column 1: unknown instruction"), "{errors}");
/// ```
///
/// # Errors
/// All syntax errors of the text, in order, up to [`MAX_ERRORS`].
pub fn assemble(text: &str) -> Result<Program, AssembleErrors> {
    if text.len() > MAX_TEXT {
        return Err(AssembleErrors::new(vec![SyntaxError::new(
            ErrorKind::TextTooLong,
            Span::new(0, 0),
            format!("at most {MAX_TEXT} bytes of program text"),
            format!("{} bytes", text.len()),
            "split the text: no card of the period runs a program of this length",
        )]));
    }
    let parsed = if gl::is_program(text) { gl::assemble(text) } else { parser::Parser::new(text).run() };
    let source = ProgramText::new(text);
    match parsed {
        Ok(program) => Ok(Program { text: source, ..program }),
        Err(errors) => Err(AssembleErrors { text: source, ..errors }),
    }
}

/// Prints a program in canonical form, which [`assemble`] parses back to an equal program: in lower case for Direct3D's
/// versions, in the extensions' case for OpenGL's.
pub fn print(program: &Program) -> String {
    if program.version.is_fragment_program() { gl::print(program) } else { print::print(program) }
}

/// The names that an `!!ARBfp1.0` program declares for `program.local[#]` and `program.env[#]`, with their constants:
/// `tint` for `PARAM tint = program.local[0]`, `t[1]` for an element of the array `t`. Empty for other versions.
pub fn parameter_names(program: &Program) -> BTreeMap<String, Register> {
    match program.version {
        Version::ArbFp1_0 => gl::parameter_names(program.text.as_str()),
        _ => BTreeMap::new(),
    }
}

/// Name of a register in program text: `r0`, `R0`, `f[TEX0]`, `result.color`. Temporaries of `!!ARBfp1.0` are named
/// `R0` and so on, as declared by [`print()`].
pub fn register_name(program: &Program, register: &Register) -> String {
    match program.version.is_fragment_program() {
        true => gl::register_name(program, register),
        false => register.to_string(),
    }
}
