//! The one error of front ends.

use std::borrow::Cow;

use miette::{Diagnostic, SourceSpan};

use crate::isa::Span;

/// A text that cannot be translated: reason, place, advice.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, Diagnostic)]
#[error("{message}")]
#[diagnostic(code("front::wgsl"), help("{help}"))]
pub struct Refusal {
    message: String,
    help: Cow<'static, str>,
    #[label("here")]
    span: SourceSpan,
}

impl Refusal {
    pub(super) fn new(message: impl Into<String>, span: Span) -> Self {
        let help = "docs/wgsl.md lists what is translated".into();
        Self { message: message.into(), help, span: span.into() }
    }

    #[must_use]
    pub(super) fn help(self, help: impl Into<Cow<'static, str>>) -> Self {
        Self { help: help.into(), ..self }
    }

    /// First byte and length of the place in the text.
    pub fn place(&self) -> (usize, usize) {
        (self.span.offset(), self.span.len())
    }
}
