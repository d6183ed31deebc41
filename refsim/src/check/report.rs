//! Violations and warnings as data, without rendering.

use std::fmt;

use miette::{Diagnostic, LabeledSpan};

use super::allowed::Allowed;
use super::{RuleId, WarningId};
use crate::isa::{Span, Version};

/// One breach of one rule.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Violation {
    /// The rule.
    pub rule: RuleId,
    /// The place in the program text.
    pub span: Span,
    /// The sentence: what was found, and what is allowed.
    pub message: String,
    /// What to write at the place.
    pub label: String,
    /// What to do about it; names the profile key where a figure decides.
    pub help: String,
    /// The profile key of the figure that decides, `limits.temporaries` for example.
    pub key: Option<&'static str>,
    /// The figure.
    pub limit: Option<u32>,
    /// What the program has instead.
    pub found: Option<u32>,
}

impl Violation {
    /// A violation without a figure; the label repeats the rule.
    pub(super) fn new(rule: RuleId, span: Span, message: impl Into<String>) -> Self {
        Self {
            rule,
            span,
            message: message.into(),
            label: "here".to_owned(),
            help: format!("{}: {}", rule.code(), rule.text()),
            key: None,
            limit: None,
            found: None,
        }
    }

    pub(super) fn label(&mut self, label: impl Into<String>) -> &mut Self {
        self.label = label.into();
        self
    }

    pub(super) fn help(&mut self, help: impl Into<String>) -> &mut Self {
        self.help = help.into();
        self
    }

    /// The figure, and what the program has instead.
    pub(super) fn figure(&mut self, limit: u32, found: u32) -> &mut Self {
        (self.limit, self.found) = (Some(limit), Some(found));
        self
    }

    /// The figure that `allowed` is.
    pub(super) fn exceeds(&mut self, found: u32, allowed: &Allowed, advice: &str) {
        self.key = Some(allowed.key);
        self.figure(allowed.value, found).help(allowed.help(advice));
    }
}

impl Diagnostic for Violation {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(format!("check::{}", self.rule)))
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.help))
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(Some(self.label.clone()), self.span))))
    }
}

/// Something legal that does not do what its text says. The program runs as the card would run it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Which warning.
    pub id: WarningId,
    /// The place in the program text.
    pub span: Span,
    /// The sentence: what was found, and what becomes of it.
    pub message: String,
    /// What to do about it.
    pub help: &'static str,
}

/// Everything that is wrong with a program for a device: never empty.
///
/// The report knows places, not the text; attach the text with [`miette::Report::with_source_code`] to see them.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, Diagnostic)]
#[error(
    "the {version} program is not legal on `{device}`: {} violation{}",
    violations.len(), if violations.len() == 1 { "" } else { "s" }
)]
#[diagnostic(code("check"))]
pub struct CheckReport {
    /// The program's version.
    pub version: Version,
    /// The device.
    pub device: String,
    /// The violations in the order of the text.
    #[related]
    pub violations: Vec<Violation>,
    /// The warnings in the order of the text.
    pub warnings: Vec<Warning>,
}
