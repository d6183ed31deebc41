//! Rendering of a page as one self-contained HTML file.

mod figure;
mod overview;
mod style;
mod table;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use self::figure::{drawing, pictures};
use self::overview::{contents, section, small_counts, summary, summary_lines};
pub(crate) use self::style::sheet;
use self::table::scrolling;
use super::Provenance;
use super::findings::{Findings, Legend, Passage};
use super::visible::visible;
use crate::error::InputError;

/// Adds search, choices and sorting to tables, and comparison to pictures: the page is complete without it.
const SCRIPT: &str = include_str!("page.js");

/// Renders the page as one self-contained HTML file, with pictures (`pngs`), charts (`drawings`), style and script
/// embedded. Conclusion and tally come first, the provenance last.
pub(super) fn html(
    findings: &Findings,
    pngs: &[Vec<u8>],
    drawings: &[String],
    provenance: &Provenance,
) -> Result<String, InputError> {
    // The table of contents precedes the first heading.
    let is_heading = |passage: &Passage| matches!(passage, Passage::Heading(..));
    let lead = findings.text.iter().position(is_heading).unwrap_or(findings.text.len());
    let mut parts = Vec::new();
    for (place, passage) in findings.text.iter().enumerate() {
        parts.push(match passage {
            Passage::Heading(text, tally) => html! { h2 id=(section(place)) { (text) } (small_counts(tally)) },
            Passage::SummaryLines(all) => summary_lines(all, findings),
            Passage::Paragraph(text) => html! { p { (text) } },
            Passage::Table(table) => scrolling(&findings.tables[*table].table, *table, &findings.tally),
            Passage::Chart(chart) => drawing(&drawings[*chart], &findings.charts[*chart].caption),
            Passage::Pictures(places) => pictures(&findings.pictures, pngs, places.clone()),
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
                style { (PreEscaped(sheet())) }
            }
            body {
                main {
                    h1 { (findings.title) }
                    (summary(findings))
                    @for part in before { (part) }
                    (contents(findings))
                    @for part in after { (part) }
                    (render_provenance(provenance))
                }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    // Tags, styles and drawings have no hidden characters: only external text is escaped.
    Ok(visible(&page.into_string()).into_owned())
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
