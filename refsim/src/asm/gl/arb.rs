//! `!!ARBfp1.0`: GL_ARB_fragment_program.

use super::super::error::{AssembleErrors, ErrorKind, SyntaxError};
use crate::isa::{Program, Span};

/// Reads a program whose first word is `!!ARBfp1.0` at `header`.
pub(super) fn assemble(_: &str, header: Span) -> Result<Program, AssembleErrors> {
    let error = SyntaxError::new(ErrorKind::UnknownVersion, header, "`!!FP1.0`", "`!!ARBfp1.0`", "not read yet");
    Err(AssembleErrors { errors: vec![error] })
}

/// The statements in front of a program's instructions.
pub(super) fn declarations(_: &Program, _: &mut String) {}
