//! Rendering of a page as one self-contained HTML file: the first screen with conclusion, counts and table of contents,
//! then text, tables that scroll in their boxes, pictures and charts. Colors are from the palette; the rest of the style
//! is in `page.css`.

use std::ops::Range;

use base64::{Engine as _, engine::general_purpose::STANDARD};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::findings::{Findings, Legend, Passage, Verdict};
use super::palette::{Color, DARK, LIGHT, Theme};
use super::summary::{SummaryLine, TallyEntry};
use super::visible::visible;
use super::{Cell, NamedPicture, Provenance, Table};
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

fn section(place: usize) -> String {
    format!("section-{place}")
}

/// Renders the conclusion, its first sentence as the verdict, and the tally as counts and as a bar.
fn summary(findings: &Findings) -> Markup {
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
fn small_counts(tally: &[TallyEntry]) -> Markup {
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
fn summary_lines(lines: &[SummaryLine], findings: &Findings) -> Markup {
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
fn contents(findings: &Findings) -> Markup {
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

/// Width in pixels up to which a picture is enlarged by a whole factor, and the largest factor.
const SMALL: u32 = 320;
const LARGEST: u32 = 8;
const ZOOMED: u32 = 1200;

/// Renders a chart; the SVG is our own and inserted unescaped.
fn drawing(svg: &str, caption: &str) -> Markup {
    html! {
        figure.drawing {
            div.frame tabindex="0" role="region" aria-label=(caption) { (PreEscaped(svg)) }
            figcaption { (caption) }
        }
    }
}

/// Renders pictures side by side at native resolution, as many per row as fit; small ones are enlarged by a whole
/// factor. A narrow screen shows a picture scaled down and smoothed, which preserves the fraction of marked pixels. A
/// click shows all pixels. The script adds a slider between pictures of the same size.
fn pictures(all: &[NamedPicture], pngs: &[Vec<u8>], places: Range<usize>) -> Markup {
    html! { div.figures { @for place in places { (figure(&all[place], &pngs[place], place)) } } }
}

fn figure(picture: &NamedPicture, png: &[u8], place: usize) -> Markup {
    let (id, caption) = (format!("picture-{place}"), format!("caption-{place}"));
    let (width, height) = picture.image.dimensions();
    let factor = (SMALL / width.max(1)).clamp(1, LARGEST);
    let zoomed = width * (ZOOMED / width.max(1)).max(1);
    let shown = factor * width;
    let source = format!("data:image/png;base64,{}", STANDARD.encode(png));
    html! {
        figure.picture id=(id) style=(format!("--shown: {shown}px; --zoomed: {zoomed}px")) {
            a.close href=(format!("#{caption}")) { "Back to the page" }
            div.frame {
                a href=(format!("#{id}")) title="All pixels" {
                    img src=(source) alt=(picture.caption) width=(shown) height=(factor * height)
                        class=[(factor > 1).then_some("enlarged")];
                }
            }
            figcaption id=(caption) { (picture.caption) }
        }
    }
}

/// Name of the column that the page moves to second place; files keep the order.
const VERDICT: &str = "verdict";

/// Maximum number of rows of a table shown in full; a longer table scrolls in a box as high as the window.
const LONG: usize = 25;

/// Renders a table in a box that scrolls; `place` determines its id, and `tally` gives the tone of each verdict.
///
/// The script of the page adds search, choices and sorting.
fn scrolling(table: &Table, place: usize, tally: &[TallyEntry]) -> Markup {
    let id = format!("table-{place}");
    let headings = table.shown_headings();
    let verdict = table.headings().iter().position(|heading| heading == VERDICT).filter(|column| *column > 0);
    let others = (1..headings.len()).filter(|column| Some(*column) != verdict);
    let columns: Vec<usize> = [0].into_iter().chain(verdict).chain(others).collect();
    let style = |row: &[Cell]| {
        if row.iter().any(|cell| matches!(cell, Cell::Folded(_))) {
            return Some("folded");
        }
        let said = row[verdict?].text();
        tally.iter().find(|entry| entry.what == said).map(|entry| entry.tone.class())
    };
    let number = |cell: &Cell| cell.is_number().then_some("number");
    let class = |column: usize, cell: &Cell| if Some(column) == verdict { Some("said") } else { number(cell) };
    html! {
        // Scrollable regions are focusable by keyboard, and have a name.
        div.scroll.long[table.rows().len() > LONG] tabindex="0" role="region" aria-labelledby=(id) {
            table {
                caption id=(id) { (table.title()) }
                thead { tr { @for &column in columns.iter().take(headings.len()) { th scope="col" { (headings[column]) } } } }
                tbody {
                    @for (n, row) in table.rows().iter().enumerate() {
                        @let name = table.name(n);
                        tr id=[name] class=[style(row)] {
                            @for &column in columns.iter().take(row.len()) {
                                @let text = row[column].text();
                                @if column > 0 {
                                    td class=[class(column, &row[column])] { (text) }
                                } @else if let Some(name) = name {
                                    th scope="row" { (text) " " a.anchor href=(format!("#{name}")) title="Link to this row" { "#" } }
                                } @else {
                                    th scope="row" { (text) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Accent colors of links and outcomes. Good, neutral and bad outcomes are blue, grey and orange of Okabe and Ito
/// (2008), adjusted for contrast with each page. All accents can be told apart with any color vision.
type Accents = [(&'static str, Color); 7];

const ON_LIGHT: Accents = [
    ("link", [0x00, 0x5a, 0x8f]),
    ("good", [0x00, 0x72, 0xb2]),
    ("fair", [0x06, 0x4c, 0x29]),
    ("neutral", [0x85, 0x8b, 0x93]),
    ("excused", [0x51, 0x4d, 0x00]),
    ("odd", [0xbf, 0x0d, 0xfa]),
    ("bad", [0xd5, 0x5e, 0x00]),
];
const ON_DARK: Accents = [
    ("link", [0x7c, 0xc0, 0xee]),
    ("good", [0x4b, 0xa3, 0xdb]),
    ("fair", [0xb4, 0xfb, 0xab]),
    ("neutral", [0x85, 0x8b, 0x93]),
    ("excused", [0xf6, 0xf3, 0x11]),
    ("odd", [0xcc, 0x0e, 0xff]),
    ("bad", [0xf0, 0x7b, 0x1f]),
];

/// Returns the style sheet, which follows the reader's choice of a light or dark page.
pub(crate) fn sheet() -> String {
    format!(
        "\n:root {{ color-scheme: light dark; {} }}\n@media (prefers-color-scheme: dark) {{ :root {{ {} }} }}\n{}",
        variables(&LIGHT, ON_LIGHT),
        variables(&DARK, ON_DARK),
        include_str!("page.css"),
    )
}

fn variables(theme: &Theme, accents: Accents) -> String {
    let Theme { paper, ink, quiet, rule, soft } = *theme;
    let all = [("paper", paper), ("ink", ink), ("quiet", quiet), ("rule", rule), ("soft", soft)].into_iter();
    let variable = |(name, [r, g, b]): (&str, Color)| format!("--{name}: #{r:02x}{g:02x}{b:02x};");
    all.chain(accents).map(variable).collect::<Vec<_>>().join(" ")
}
