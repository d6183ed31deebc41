//! From text to expressions: FPCore and formulas in infix notation, both through one tree.

mod error;
mod infix;
mod numbers;
mod text;
mod translate;

pub use error::ExpressionError;
pub(super) use translate::{bounds, formula};

use std::sync::Arc;

use self::text::Tree;
use self::translate::core;
use super::graph::Expression;
use crate::report::SourceText;

/// Expressions of an FPCore file in order; an unsupported one is an error with the reason.
///
/// # Errors
/// If brackets are unbalanced, or something is outside of `(FPCore ...)`.
pub(super) fn cores(source: &Arc<SourceText>) -> Result<Vec<Result<Expression, ExpressionError>>, ExpressionError> {
    let error = |message: &str, place| ExpressionError::new(source, message, place);
    let trees = text::parse(source)?;
    if trees.is_empty() {
        return Err(error("expected `(FPCore ...)`, found no expression", 0..source.text().len()));
    }
    let expect = |tree: &Tree| match tree.head() {
        Some("FPCore") => Ok(core(tree, source)),
        _ => Err(error("expected `(FPCore (ARGUMENTS) ... BODY)`", tree.place())),
    };
    trees.iter().map(expect).collect()
}
