//! Errors in the text of expressions.

use std::ops::Range;
use std::sync::Arc;

use miette::{Diagnostic, SourceSpan};

use crate::report::SourceText;

/// Error of a text that is not an expression, or is not supported: the reason and the position.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, Diagnostic)]
#[error("{message}")]
#[diagnostic(code(crossbar::expression), help("docs/precision.md lists what is supported"))]
pub struct ExpressionError {
    message: String,
    #[source_code]
    source_code: Arc<SourceText>,
    #[label("here")]
    span: SourceSpan,
}

impl ExpressionError {
    pub(in crate::study::precision::expression) fn new(
        source: &Arc<SourceText>,
        message: impl Into<String>,
        place: Range<usize>,
    ) -> Self {
        Self { message: message.into(), source_code: Arc::clone(source), span: place.into() }
    }

    /// Line and column of the error, from 1.
    pub fn line_and_column(&self) -> (usize, usize) {
        let at = self.span.offset();
        (self.source_code.line_of(at) + 1, self.source_code.column_of(at) + 1)
    }
}
