//! The first screen of a page: conclusion, counts, a line per part and the table of contents.

use maud::{Markup, html};

use super::super::findings::{Findings, Passage, Verdict};
use super::super::summary::{SummaryLine, TallyEntry};

pub(super) fn section(place: usize) -> String {
    format!("section-{place}")
}

/// Renders the conclusion, its first sentence as the verdict, and the tally as counts and as a bar.
pub(super) fn summary(findings: &Findings) -> Markup {
    let failed = findings.verdict() == Verdict::Failed;
    html! {
        @if !(findings.conclusion.is_empty() && findings.tally.is_empty()) {
            section.summary.failed[failed] aria-label="Conclusion" {
                @for (n, sentence) in findings.conclusion.iter().enumerate() { p class=[(n == 0).then_some("verdict")] { (sentence) } }
                @if !findings.tally.is_empty() { (counts(findings.tally.iter())) (bar(&findings.tally)) }
            }
        }
    }
}

fn counts<'a>(tally: impl Iterator<Item = &'a TallyEntry>) -> Markup {
    html! { ul.tally { @for entry in tally { li class=(entry.tone.class()) { b { (entry.count) } " " (entry.what) } } } }
}

/// Renders the counts that are not 0 as a list; nothing if there are none.
pub(super) fn small_counts(tally: &[TallyEntry]) -> Markup {
    let found = || tally.iter().filter(|entry| entry.count > 0);
    html! { @if found().next().is_some() { (counts(found())) } }
}

fn bar(tally: &[TallyEntry]) -> Markup {
    html! {
        div.bar aria-hidden="true" {
            @for entry in tally.iter().filter(|entry| entry.count > 0) {
                span class=(entry.tone.class()) style=(format!("flex-grow:{}", entry.count)) {}
            }
        }
    }
}

/// Renders lines: title, counts and a sentence.
pub(super) fn summary_lines(lines: &[SummaryLine], findings: &Findings) -> Markup {
    let heading = |line: &SummaryLine| {
        findings.text.iter().position(|passage| matches!(passage, Passage::Heading(text, _) if *text == line.heading))
    };
    html! {
        ul.lines {
            @for line in lines {
                li {
                    div {
                        strong {
                            @match heading(line) {
                                Some(place) => a href=(format!("#{}", section(place))) { (line.title) },
                                None => (line.title),
                            }
                        }
                        (small_counts(&line.tally))
                        @if !line.text.is_empty() { p { (line.text) } }
                    }
                    (bar(&line.tally))
                }
            }
        }
    }
}

/// Renders the table of contents, each heading with its counts.
pub(super) fn contents(findings: &Findings) -> Markup {
    let headings: Vec<(usize, &str, &[TallyEntry])> = findings
        .text
        .iter()
        .enumerate()
        .filter_map(|(place, passage)| match passage {
            Passage::Heading(text, tally) => Some((place, text.as_str(), tally.as_slice())),
            _ => None,
        })
        .collect();
    html! {
        @if !headings.is_empty() {
            nav aria-label="Contents" {
                strong { "On this page" }
                ul {
                    @for (place, text, tally) in headings {
                        li { a href=(format!("#{}", section(place))) { (text) } (small_counts(tally)) }
                    }
                    li { a href="#provenance" { "Provenance" } }
                }
            }
        }
    }
}
