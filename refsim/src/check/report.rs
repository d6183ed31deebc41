//! Violations and warnings as data, without rendering.

use std::fmt;

use miette::{Diagnostic, LabeledSpan, SourceSpan};

use super::{RuleId, WarningId};
use crate::isa::{Span, Version};

/// One breach of one rule.
#[derive(Clone, Debug, PartialEq, Eq)]
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

    pub(super) fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Violation {}

impl Diagnostic for Violation {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(format!("check::{}", self.rule)))
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.help))
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let (start, end) = (self.span.start as usize, self.span.end as usize);
        let span = SourceSpan::new(start.into(), end.saturating_sub(start));
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(Some(self.label.clone()), span))))
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
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckReport {
    /// The program's version.
    pub version: Version,
    /// The device.
    pub device: String,
    /// The violations in the order of the text.
    pub violations: Vec<Violation>,
    /// The warnings in the order of the text.
    pub warnings: Vec<Warning>,
}

impl fmt::Display for CheckReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let n = self.violations.len();
        let plural = if n == 1 { "" } else { "s" };
        write!(f, "the {} program is not legal on `{}`: {n} violation{plural}", self.version, self.device)
    }
}

impl std::error::Error for CheckReport {}

impl Diagnostic for CheckReport {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new("check"))
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.violations.iter().map(|v| v as &dyn Diagnostic)))
    }
}
