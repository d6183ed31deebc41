//! One HTML file with everything inside it.

use base64::{Engine as _, engine::general_purpose::STANDARD};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::findings::{Findings, Passage};
use super::visible::visible;
use super::{Provenance, Table};

/// The page as one HTML file that needs nothing else: pictures (`pngs`), charts (`drawings`) and style are inside it,
/// scripts there are none. The provenance comes last.
pub(super) fn html(findings: &Findings, pngs: &[Vec<u8>], drawings: &[String], provenance: &Provenance) -> String {
    let passage = |passage: &Passage| match passage {
        Passage::Heading(text) => html! { h2 { (text) } },
        Passage::Paragraph(text) => html! { p { (text) } },
        Passage::Table(place) => render_table(&findings.tables[*place].table),
        // The drawing is of our own making, and put in as it is.
        Passage::Chart(place) => html! {
            figure.drawing { (PreEscaped(&drawings[*place])) figcaption { (findings.charts[*place].caption) } }
        },
        Passage::Pictures(places) => html! {
            div.figures {
                @for (picture, png) in findings.pictures[places.clone()].iter().zip(&pngs[places.clone()]) {
                    figure {
                        img src=(format!("data:image/png;base64,{}", STANDARD.encode(png))) alt=(picture.caption);
                        figcaption { (picture.caption) }
                    }
                }
            }
        },
    };
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (findings.title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                main {
                    h1 { (findings.title) }
                    @for part in &findings.text { (passage(part)) }
                    (render_provenance(provenance))
                }
            }
        }
    };
    // Tags, styles and drawings have nothing hidden in them: what is escaped is text from outside.
    visible(&page.into_string()).into_owned()
}

fn render_table(table: &Table) -> Markup {
    html! {
        div.scroll {
            table {
                @if !table.title().is_empty() { caption { (table.title()) } }
                thead { tr { @for heading in table.headings() { th scope="col" { (heading) } } } }
                tbody {
                    @for row in table.rows() {
                        tr { @for cell in row { td.number[cell.is_number()] { (cell.text()) } } }
                    }
                }
            }
        }
    }
}

fn render_provenance(provenance: &Provenance) -> Markup {
    html! {
        section.provenance {
            h2 { "Provenance" }
            dl { @for (name, value) in provenance.rows() { dt { (name) } dd { (value) } } }
        }
    }
}

/// Follows the reader's choice of a light or dark page. Pictures are not smoothed: a pixel is a result.
const STYLE: &str = "
:root { color-scheme: light dark; --ink: #1c1e21; --paper: #fcfcfa; --rule: #cfd2d6; --soft: #f0f1ee; --quiet: #5c6168; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e5e7; --paper: #16181b; --rule: #3b3f45; --soft: #202329; --quiet: #9aa0a8; }
}
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
main { max-width: 76rem; margin: 0 auto; padding: 1.5rem; }
h1 { font-size: 1.7rem; line-height: 1.2; }
h2 { font-size: 1.2rem; margin-top: 2.5rem; }
p { max-width: 46rem; }
.scroll { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding-bottom: .4rem; }
th, td { padding: .25rem .8rem; border-bottom: 1px solid var(--rule); text-align: left; vertical-align: top; }
th { background: var(--soft); }
td.number { text-align: right; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(17rem, 1fr)); gap: 1.2rem; margin: 1rem 0; }
figure { margin: 0; }
img { width: 100%; height: auto; image-rendering: pixelated; background: var(--soft); border: 1px solid var(--rule); box-sizing: border-box; }
figure.drawing { margin: 1rem 0; max-width: 46rem; }
.drawing svg { width: 100%; height: auto; border: 1px solid var(--rule); box-sizing: border-box; }
figcaption { font-size: .85rem; color: var(--quiet); margin-top: .3rem; }
.provenance { margin-top: 3rem; border-top: 1px solid var(--rule); font-size: .85rem; color: var(--quiet); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1rem; }
dt { font-weight: 600; }
dd { margin: 0; overflow-wrap: anywhere; }
";

#[cfg(test)]
mod tests {
    use super::super::NamedPicture;
    use super::*;
    use crate::picture::RgbImage;

    #[test]
    fn the_page_stands_alone_and_escapes_what_it_is_given() {
        let mut table = Table::new("a <b> table", &["x", "n"]);
        table.push(["<script>".into(), 3_u32.into()]);
        let mut findings = Findings::new("T & U");
        findings.heading("Pictures");
        findings.paragraph("Some text.");
        findings.table(table);
        findings.table(Table::new("an empty table", &["x"]));
        findings.pictures(vec![NamedPicture::new("p", RgbImage::new(1, 1), "a \"quoted\" caption")]);
        let files = findings.take_files(&Provenance::new("crossbar leaky-teapot --size 8x8")).expect("a picture");
        let names: Vec<&str> = files.iter().map(|file| file.0.as_str()).collect();
        assert_eq!(names, ["p.png", "study.json", "index.html"]);
        let page = String::from_utf8(files[2].1.clone()).expect("text");
        assert!(page.contains("T &amp; U"), "the title is escaped");
        assert!(page.contains("&lt;script&gt;") && !page.contains("an empty table"), "cells are escaped");
        assert!(page.contains("data:image/png;base64,iVBORw0K"), "pictures are inside");
        assert!(page.contains("crossbar leaky-teapot --size 8x8"), "the command is told");
        assert!(!page.contains("http"), "nothing is fetched");
        assert!(!page.contains("<script"), "no scripts");
    }
}
