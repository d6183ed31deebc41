//! A diagnostic for display: hidden characters escaped, long lines truncated, a limited number of errors.

use std::fmt;

use miette::{Diagnostic, LabeledSpan, Severity, SourceCode};

use crate::report::Excerpt;
use crate::report::visible::visible;

/// Maximum number of errors shown per list.
pub(super) const MAX_SHOWN: usize = 20;

/// A copy of a diagnostic that any renderer may write to a terminal unchanged.
#[derive(Debug, Default)]
pub(super) struct ShownError {
    message: String,
    code: Option<String>,
    severity: Option<Severity>,
    help: Option<String>,
    url: Option<String>,
    excerpt: Option<Excerpt>,
    labels: Vec<LabeledSpan>,
    related: Vec<Self>,
    more: usize,
    cause: Option<Box<Self>>,
    /// `true` if a cause is a diagnostic, so that its code and help are shown.
    cause_is_diagnostic: bool,
}

impl ShownError {
    /// Copies a diagnostic with the first `most` related diagnostics of each list.
    pub(super) fn new(diagnostic: &dyn Diagnostic, most: usize) -> Self {
        Self::within(diagnostic, None, most)
    }

    /// Copies a diagnostic; one without source text uses the source text of `outer`.
    fn within(diagnostic: &dyn Diagnostic, outer: Option<&dyn SourceCode>, most: usize) -> Self {
        let source = diagnostic.source_code().or(outer);
        let labels: Vec<LabeledSpan> = diagnostic.labels().map(Iterator::collect).unwrap_or_default();
        let (excerpt, labels) = match source.and_then(|source| Excerpt::new(source, &labels)) {
            Some((excerpt, labels)) => (Some(excerpt), labels),
            None => (None, Vec::new()),
        };
        let mut related = diagnostic.related().into_iter().flatten();
        let first = related.by_ref().take(most).map(|one| Self::within(one, source, most)).collect();
        let cause = diagnostic.diagnostic_source().map(|cause| Self::within(cause, source, most));
        Self {
            code: diagnostic.code().map(|code| visible(&code.to_string()).into_owned()),
            severity: diagnostic.severity(),
            help: diagnostic.help().map(|help| visible(&help.to_string()).into_owned()),
            url: diagnostic.url().map(|url| visible(&url.to_string()).into_owned()),
            excerpt,
            labels,
            related: first,
            more: related.count(),
            cause_is_diagnostic: cause.is_some(),
            cause: cause.or_else(|| diagnostic.source().map(Self::plain)).map(Box::new),
            ..Self::message(&diagnostic.to_string())
        }
    }

    fn plain(error: &dyn std::error::Error) -> Self {
        Self { cause: error.source().map(Self::plain).map(Box::new), ..Self::message(&error.to_string()) }
    }

    fn message(text: &str) -> Self {
        Self { message: visible(text).into_owned(), ..Self::default() }
    }

    /// Number of omitted errors over all lists.
    pub(super) fn left_out(&self) -> usize {
        self.more + self.related.iter().chain(self.cause.as_deref()).map(Self::left_out).sum::<usize>()
    }
}

impl fmt::Display for ShownError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for ShownError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.cause.as_deref().map(|cause| cause as &(dyn std::error::Error + 'static))
    }
}

impl Diagnostic for ShownError {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.code.as_ref().map(|code| Box::new(code) as Box<dyn fmt::Display>)
    }

    fn severity(&self) -> Option<Severity> {
        self.severity
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn url<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.url.as_ref().map(|url| Box::new(url) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.excerpt.as_ref().map(|excerpt| excerpt as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        (!self.labels.is_empty())
            .then(|| Box::new(self.labels.iter().cloned()) as Box<dyn Iterator<Item = LabeledSpan>>)
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        if self.related.is_empty() {
            return None;
        }
        Some(Box::new(self.related.iter().map(|one| one as &dyn Diagnostic)))
    }

    fn diagnostic_source(&self) -> Option<&dyn Diagnostic> {
        let cause = self.cause.as_deref().filter(|_| self.cause_is_diagnostic)?;
        Some(cause)
    }
}
