//! The error type of all front ends.

use std::borrow::Cow;

use crate::isa::Span;

/// Error: the text cannot be translated. Holds the reason, the position and advice.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Refusal {
    message: String,
    help: Cow<'static, str>,
    place: Option<Span>,
}

impl Refusal {
    pub(super) fn new(message: impl Into<String>, span: Span) -> Self {
        let help = "docs/wgsl.md lists what is translated".into();
        Self { message: message.into(), help, place: Some(span).filter(|span| span.end > 0) }
    }

    #[must_use]
    pub(super) fn with_help(self, help: impl Into<Cow<'static, str>>) -> Self {
        Self { help: help.into(), ..self }
    }

    /// Advice for correcting the text.
    pub fn help(&self) -> &str {
        &self.help
    }

    /// Span of the cause in the text; `None` if the cause has no position.
    pub fn place(&self) -> Option<Span> {
        self.place
    }
}
