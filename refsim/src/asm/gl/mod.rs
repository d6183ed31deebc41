//! OpenGL fragment programs: `!!FP1.0` (GL_NV_fragment_program) and `!!ARBfp1.0` (GL_ARB_fragment_program).
//!
//! - `operand`: operands and numbers, shared by both languages
//! - `build`: builder of the program
//! - `nv`; `arb` with `arb_names` and `arb_state`: parsers of the two languages
//! - `print`: printer of both

mod arb;
mod arb_names;
mod arb_state;
mod build;
mod nv;
mod operand;
mod print;

use std::collections::BTreeMap;

use super::error::{AssembleErrors, ErrorKind, SyntaxError, quote};
use crate::isa::{Program, Register, Span, Version};
pub(super) use print::{print, register_name};

/// Returns `true` if the text is an OpenGL program: it starts with `!!`.
pub(super) fn is_program(text: &str) -> bool {
    body(text).starts_with("!!")
}

/// Skips white space and leading lines that start with `//` (an extension for this project's files).
fn body(text: &str) -> &str {
    let mut rest = text.trim_start_matches('\u{feff}').trim_ascii_start();
    while rest.starts_with("//") {
        rest = rest.find(['\n', '\r']).map_or("", |end| rest[end..].trim_ascii_start());
    }
    rest
}

/// The place of the version of a program that starts with `!!`.
fn header(text: &str) -> Span {
    let rest = body(text);
    let start = text.len() - rest.len();
    let end = rest.find(|c: char| c.is_ascii_whitespace() || matches!(c, ';' | '#')).unwrap_or(rest.len());
    Span::new(start as u32, (start + end) as u32)
}

/// See [`super::parameter_names`].
pub(super) fn parameter_names(text: &str) -> BTreeMap<String, Register> {
    arb::parameter_names(text, header(text))
}

/// Parses a program that starts with `!!`.
pub(super) fn assemble(text: &str) -> Result<Program, AssembleErrors> {
    let span = header(text);
    let version = &text[span.start as usize..span.end as usize];
    match version.parse() {
        Ok(Version::Fp1_0) => nv::assemble(text, span),
        Ok(Version::ArbFp1_0) => arb::assemble(text, span),
        _ => Err(AssembleErrors::new(vec![SyntaxError::new(
            ErrorKind::UnknownVersion,
            span,
            "`!!FP1.0` or `!!ARBfp1.0`",
            quote(version),
            "these two program languages of OpenGL are supported",
        )])),
    }
}
