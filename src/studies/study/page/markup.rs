//! The page's markup, around the data, style and script.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::page_data::PageData;
use super::teapot::{FixedView, VerdictColor};
use crate::report::page_style;
use crate::report::words::counted;

/// Script of the page, in the order in which its parts need each other.
const SCRIPT: [&str; 7] = [
    include_str!("assets/helpers.js"),
    include_str!("assets/arithmetic.js"),
    include_str!("assets/native.js"),
    include_str!("assets/scene.js"),
    include_str!("assets/setup.js"),
    include_str!("assets/teapot.js"),
    include_str!("assets/main.js"),
];

/// Renders the page around its data as JSON.
pub(super) fn html(data: &PageData, json: &str) -> String {
    // A less-than sign could end the element.
    let json = json.replace('<', "\\u003c");
    let script = format!("\"use strict\";\n(() => {{\n{}}})();\n", SCRIPT.concat());
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                // Without an icon of its own a browser asks the server for one.
                link rel="icon" href="data:,";
                title { "Your GPU against the cards" }
                style { (PreEscaped(page_style())) (PreEscaped(include_str!("assets/page.css"))) }
            }
            body data-state="loading" {
                main {
                    h1 { "Your GPU against the cards of 2001" }
                    p {
                        "This page runs the arithmetic of early graphics cards on your GPU, in whole numbers, and compares \
                         every bit with Crossbar's emulator, whose results it carries. Beside it stand your GPU's own floats."
                    }
                    p #status role="status" { "Waiting for the script. Without it the page shows stored pictures." }
                    dl #adapter {}
                    (arithmetic())
                    (live(&data.teapot.verdicts))
                    (fixed_views(&data.teapot.views))
                    (results())
                    p.provenance { "Crossbar " (data.version) ". The page loads nothing and sends nothing." }
                }
                script #data type="application/json" { (PreEscaped(json)) }
                script { (PreEscaped(script)) }
            }
        }
    };
    page.into_string()
}

fn arithmetic() -> Markup {
    html! {
        section aria-labelledby="integers" {
            h2 #integers { "Operations by formats, in whole numbers" }
            p {
                "Each cell: how many of its operand sets give other bits on your GPU than in the emulator. It must be 0 \
                 everywhere, on every GPU, because only integers are used. A cell that is not 0 names the first operands \
                 that differ."
            }
            div.scroll tabindex="0" role="region" aria-label="Operations by formats" { table #cells {} }
            div #differences {}
            p { button #vectors type="button" disabled { "Save operands and results as a file" } }
        }
        section aria-labelledby="floats" {
            h2 #floats { "Your GPU's own floats" }
            p {
                "The same operands in the GPU's own arithmetic: distance of its results from the exact result rounded to \
                 nearest, in units in the last place (ULP), for normal operands and results. WGSL allows such distances; the \
                 last column counts results beyond what it allows."
            }
            div #native {}
        }
    }
}

fn live(verdicts: &[VerdictColor]) -> Markup {
    html! {
        section aria-labelledby="live" {
            h2 #live { "The teapot in any number format" }
            p {
                "The intersection program of the Ray Engine (2002), run by your GPU for every pixel, in the number format that \
                 you choose. Drag the picture, or use the arrow keys and + and - on it, to move the camera."
            }
            div.stand {
                canvas #view tabindex="0" role="application" aria-label="Teapot: arrow keys turn the camera, plus and minus move it"
                    aria-describedby="told" {}
                form #controls aria-label="Number format and view" {}
            }
            p #told role="status" {}
            ul.legend aria-label="Colors" {
                @for VerdictColor { words, color: [r, g, b] } in verdicts.iter().rev().take(4) {
                    li { span.swatch aria-hidden="true" style=(format!("background:#{r:02x}{g:02x}{b:02x}")) {} (words) }
                }
            }
        }
    }
}

fn fixed_views(views: &[FixedView]) -> Markup {
    html! {
        section aria-labelledby="fixed" {
            h2 #fixed { "Fixed views, bit for bit" }
            p {
                "Pictures of the emulator. Where your GPU can, it draws each again; triangle and distance of every pixel must \
                 have the emulator's bits."
            }
            @for (v, view) in views.iter().enumerate() {
                h3 { "Seen " (view.name) }
                div.figures {
                    @for (p, picture) in view.pictures.iter().enumerate() {
                        figure.fixed id=(format!("fixed-{v}-{p}")) {
                            img width="192" height="192" alt=(format!("The teapot in {}, seen {}: {}", picture.format, view.name, counted(picture.leaks as u64, "leak", "leaks")))
                                src=(format!("data:image/png;base64,{}", picture.png));
                            figcaption {
                                b { (picture.format) } ", " (counted(picture.leaks as u64, "leak", "leaks")) br;
                                "emulator " code { (picture.digest) } br;
                                span.found { "stored picture" }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn results() -> Markup {
    html! {
        section aria-labelledby="report" {
            h2 #report { "Results" }
            p { "All that was found, as JSON: for a bug report, or for comparison with another GPU." }
            textarea #json rows="8" readonly aria-label="Results as JSON" { "{}" }
            p { button #copy type="button" disabled { "Copy" } " " span #copied role="status" {} }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The script fetches nothing and does not end its own element.
    #[test]
    fn the_script_stands_alone() {
        for word in ["http", "fetch(", "import", "XMLHttp", "WebSocket", "eval", "innerHTML", "</", "<!--"] {
            assert!(SCRIPT.iter().all(|part| !part.contains(word)), "{word}");
        }
    }

    /// Every color of the sheet is a variable of the reports' sheet, so that a dark page uses no color of a light one.
    #[test]
    fn the_sheet_has_no_color_of_its_own() {
        let css = include_str!("assets/page.css");
        assert!(!css.contains("rgb(") && !css.contains(": #"));
    }
}
