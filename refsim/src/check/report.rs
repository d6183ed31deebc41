//! Violations and warnings as data, without rendering.

use std::fmt;

use miette::{Diagnostic, LabeledSpan};

use super::allowed::Allowed;
use super::{RuleId, WarningId};
use crate::isa::{PlacedMessage, ProgramText, Span, Version};

/// A violation of a rule.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Violation {
    /// The rule.
    pub rule: RuleId,
    /// Location in the program text.
    pub span: Span,
    /// Message: the value found and the values allowed.
    pub message: String,
    /// Label at the location.
    pub label: String,
    /// Advice; names the profile key if a limit is exceeded.
    pub help: String,
    /// Profile key of the exceeded limit, for example `limits.temporaries`.
    pub key: Option<&'static str>,
    /// The limit.
    pub limit: Option<u32>,
    /// The program's value.
    pub found: Option<u32>,
}

impl Violation {
    /// Creates a violation without a limit and with a default label.
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

    /// Sets the limit and the value found in the program.
    pub(super) fn figure(&mut self, limit: u32, found: u32) -> &mut Self {
        (self.limit, self.found) = (Some(limit), Some(found));
        self
    }

    /// Sets limit, key and help from `allowed`.
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

/// A warning about legal code that does not do what its text suggests. The program runs as the card would run it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Kind of warning.
    pub id: WarningId,
    /// Location in the program text.
    pub span: Span,
    /// Message: the instruction found, and its actual effect.
    pub message: String,
    /// Advice.
    pub help: &'static str,
}

/// All violations of a program for a device; never empty.
///
/// When displayed or returned from `main`, it quotes the line of each violation with advice. For colours and labels,
/// render each violation with the text ([`miette::Report::with_source_code`]).
#[derive(Clone, PartialEq, Eq, thiserror::Error, Diagnostic)]
#[diagnostic(code("check"))]
pub struct CheckReport {
    /// The program's version.
    pub version: Version,
    /// The device.
    pub device: String,
    /// The violations in the order of the text.
    pub violations: Vec<Violation>,
    /// The warnings in the order of the text.
    pub warnings: Vec<Warning>,
    /// The program's text; empty if it was built without one.
    pub text: ProgramText,
}

impl fmt::Display for CheckReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (count, plural) = (self.violations.len(), if self.violations.len() == 1 { "" } else { "s" });
        write!(f, "the {} program is not legal on `{}`: {count} violation{plural}", self.version, self.device)?;
        let placed = |v: &Violation| PlacedMessage { span: v.span, message: v.to_string(), help: v.help.clone() };
        self.text.write_messages(f, self.violations.iter().map(placed))
    }
}

/// Same as `Display`, because a `main` that returns the report prints this.
impl fmt::Debug for CheckReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
