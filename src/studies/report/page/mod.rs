//! Rendering of a page as one self-contained HTML file.

mod figure;
mod style;
mod table;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use self::figure::{drawing, pictures};
use self::table::scrolling;
use super::findings::{Findings, Legend, Passage, TallyEntry, Tone, Verdict};
use super::visible::visible;
use super::{Provenance, ReportError};

/// Renders the page as one self-contained HTML file: pictures (`pngs`), charts (`drawings`) and style are embedded, and
/// there are no scripts. Conclusion and tally come first, the provenance last.
pub(super) fn html(
    findings: &Findings,
    pngs: &[Vec<u8>],
    drawings: &[String],
    provenance: &Provenance,
) -> Result<String, ReportError> {
    // The table of contents precedes the first heading.
    let is_heading = |passage: &Passage| matches!(passage, Passage::Heading(_));
    let lead = findings.text.iter().position(is_heading).unwrap_or(findings.text.len());
    let mut parts = Vec::new();
    for (place, passage) in findings.text.iter().enumerate() {
        parts.push(match passage {
            Passage::Heading(text) => html! { h2 id=(section(place)) { (text) } },
            Passage::Paragraph(text) => html! { p { (text) } },
            Passage::Table(table) => scrolling(&findings.tables[*table].table, *table),
            Passage::Chart(chart) => drawing(&drawings[*chart], &findings.charts[*chart].caption),
            Passage::Pictures(places) => pictures(&findings.pictures, pngs, places.clone())?,
            Passage::Legend(legend) => render_legend(legend),
        });
    }
    let (before, after) = parts.split_at(lead);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (findings.title) }
                style { (PreEscaped(style::sheet())) }
            }
            body {
                main {
                    h1 { (findings.title) }
                    (render_summary(findings))
                    @for part in before { (part) }
                    (render_contents(findings))
                    @for part in after { (part) }
                    (render_provenance(provenance))
                }
            }
        }
    };
    // Tags, styles and drawings have no hidden characters: only external text is escaped.
    Ok(visible(&page.into_string()).into_owned())
}

/// Id of a heading, by its index in the text.
fn section(place: usize) -> String {
    format!("section-{place}")
}

/// Renders the conclusion, its first sentence as the verdict, and the tally as counts and as a bar.
fn render_summary(findings: &Findings) -> Markup {
    let failed = findings.verdict() == Verdict::Failed;
    let tone = |entry: &TallyEntry| match entry.tone {
        Tone::Good => "good",
        Tone::Neutral => "neutral",
        Tone::Bad => "bad",
    };
    html! {
        @if !(findings.conclusion.is_empty() && findings.tally.is_empty()) {
            section.summary.failed[failed] aria-label="Conclusion" {
                @for (n, sentence) in findings.conclusion.iter().enumerate() { p class=[(n == 0).then_some("verdict")] { (sentence) } }
                @if !findings.tally.is_empty() {
                    ul.tally {
                        @for entry in &findings.tally { li class=(tone(entry)) { b { (entry.count) } " " (entry.what) } }
                    }
                    div.bar aria-hidden="true" {
                        @for entry in findings.tally.iter().filter(|entry| entry.count > 0) {
                            span class=(tone(entry)) style=(format!("flex-grow:{}", entry.count)) {}
                        }
                    }
                }
            }
        }
    }
}

fn render_contents(findings: &Findings) -> Markup {
    let headings: Vec<(usize, &str)> = findings
        .text
        .iter()
        .enumerate()
        .filter_map(|(place, passage)| match passage {
            Passage::Heading(text) => Some((place, text.as_str())),
            _ => None,
        })
        .collect();
    html! {
        @if !headings.is_empty() {
            nav aria-label="Contents" {
                strong { "On this page" }
                ul {
                    @for (place, text) in headings { li { a href=(format!("#{}", section(place))) { (text) } } }
                    li { a href="#provenance" { "Provenance" } }
                }
            }
        }
    }
}

fn render_legend(legend: &Legend) -> Markup {
    html! {
        ul.legend aria-label="Colours" {
            @for ([r, g, b], what) in legend {
                li { span.swatch aria-hidden="true" style=(format!("background:#{r:02x}{g:02x}{b:02x}")) {} (what) }
            }
        }
    }
}

fn render_provenance(provenance: &Provenance) -> Markup {
    html! {
        section.provenance {
            h2 id="provenance" { "Provenance" }
            dl { @for (name, value) in provenance.rows() { dt { (name) } dd { (value) } } }
        }
    }
}
