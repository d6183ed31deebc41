//! One HTML file with everything inside it.

use base64::{Engine as _, engine::general_purpose::STANDARD};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::visible::visible;
use super::{Provenance, Table};

/// A picture with a caption.
#[derive(Clone, Debug)]
pub struct Figure {
    /// A PNG file.
    pub png: Vec<u8>,
    /// What the picture shows, for those who cannot see it.
    pub alt: String,
    /// What stands under it.
    pub caption: String,
}

impl Figure {
    /// A PNG with what stands under it; the caption serves as description too.
    pub fn new(png: Vec<u8>, caption: impl Into<String>) -> Self {
        let caption = caption.into();
        Self { png, alt: caption.clone(), caption }
    }
}

#[derive(Clone, Debug)]
enum Block {
    Heading(String),
    Text(String),
    Table(Table),
    Figures(Vec<Figure>),
    Drawing { svg: String, caption: String },
}

/// A report under construction: blocks in the order in which they were added, the provenance last.
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    blocks: Vec<Block>,
    provenance: Provenance,
}

impl Page {
    /// A page with its title and where its contents come from.
    pub fn new(title: impl Into<String>, provenance: Provenance) -> Self {
        Self { title: title.into(), blocks: Vec::new(), provenance }
    }

    /// Adds a heading.
    #[must_use]
    pub fn heading(self, text: impl Into<String>) -> Self {
        self.with(Block::Heading(text.into()))
    }

    /// Adds a paragraph of plain text.
    #[must_use]
    pub fn text(self, text: impl Into<String>) -> Self {
        self.with(Block::Text(text.into()))
    }

    /// Adds a table under its title.
    #[must_use]
    pub fn table(self, table: Table) -> Self {
        self.with(Block::Table(table))
    }

    /// Adds pictures side by side.
    #[must_use]
    pub fn figures(self, figures: Vec<Figure>) -> Self {
        self.with(Block::Figures(figures))
    }

    /// Adds an SVG drawing of our own making, which is put in as it is, with what stands under it.
    #[must_use]
    pub fn drawing(self, svg: impl Into<String>, caption: impl Into<String>) -> Self {
        self.with(Block::Drawing { svg: svg.into(), caption: caption.into() })
    }

    fn with(mut self, block: Block) -> Self {
        self.blocks.push(block);
        self
    }

    /// The page as one HTML file that needs nothing else: pictures and style are inside it, scripts there are none.
    pub fn html(&self) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    title { (self.title) }
                    style { (PreEscaped(STYLE)) }
                }
                body {
                    main {
                        h1 { (self.title) }
                        @for block in &self.blocks { (render_block(block)) }
                        (render_provenance(&self.provenance))
                    }
                }
            }
        };
        // Tags, styles and drawings have nothing hidden in them: what is escaped is text from outside.
        visible(&page.into_string()).into_owned()
    }
}

fn render_block(block: &Block) -> Markup {
    match block {
        Block::Heading(text) => html! { h2 { (text) } },
        Block::Text(text) => html! { p { (text) } },
        Block::Table(table) => render_table(table),
        Block::Drawing { svg, caption } => html! {
            figure.drawing { (PreEscaped(svg)) figcaption { (caption) } }
        },
        Block::Figures(figures) => html! {
            div.figures {
                @for figure in figures {
                    figure {
                        img src=(format!("data:image/png;base64,{}", STANDARD.encode(&figure.png))) alt=(figure.alt);
                        figcaption { (figure.caption) }
                    }
                }
            }
        },
    }
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
    use super::*;

    #[test]
    fn the_page_stands_alone_and_escapes_what_it_is_given() {
        let mut table = Table::new("a <b> table", &["x", "n"]);
        table.push(["<script>".into(), 3_u32.into()]);
        let page = Page::new("T & U", Provenance::new("crossbar leaky-teapot --size 8x8"))
            .heading("Pictures")
            .text("Some text.")
            .table(table)
            .figures(vec![Figure::new(vec![1, 2, 3], "a \"quoted\" caption")])
            .html();
        assert!(page.contains("T &amp; U"), "the title is escaped");
        assert!(page.contains("&lt;script&gt;"), "cells are escaped");
        assert!(page.contains("data:image/png;base64,AQID"), "pictures are inside");
        assert!(page.contains("crossbar leaky-teapot --size 8x8"), "the command is told");
        assert!(!page.contains("http"), "nothing is fetched");
        assert!(!page.contains("<script"), "no scripts");
    }
}
