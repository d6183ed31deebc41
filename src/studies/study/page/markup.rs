//! The page's markup, around the data, style and script.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use strum::VariantArray as _;

use super::own::{self, Emulator};
use super::teapot::FixedView;
use crate::report::page_style;
use crate::report::words::counted;
use crate::study::leaky_teapot::PixelVerdict;

/// Script of the page, in the order in which its parts need each other.
const SCRIPT: [&str; 9] = [
    include_str!("assets/helpers.js"),
    include_str!("assets/arithmetic.js"),
    include_str!("assets/native.js"),
    include_str!("assets/scene.js"),
    include_str!("assets/setup.js"),
    include_str!("assets/teapot.js"),
    include_str!("assets/numbers.js"),
    include_str!("assets/programs.js"),
    include_str!("assets/stepper.js"),
];

const MAIN: &str = include_str!("assets/main.js");

/// The page; `json` is the data that its script reads.
pub(super) fn html(version: &str, views: &[FixedView], json: &str, emulator: Option<&Emulator>) -> String {
    // A less-than sign could end the element.
    let json = json.replace('<', "\\u003c");
    let script = format!("\"use strict\";\n(() => {{\n{}}})();\n", SCRIPT.concat() + &own::script(emulator) + MAIN);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                // Without this link, a browser requests an icon from the server.
                link rel="icon" href="data:,";
                title { "Your GPU against the cards" }
                style { (PreEscaped(page_style())) (PreEscaped(include_str!("assets/page.css"))) }
            }
            body data-state="loading" {
                main {
                    h1 { "Your GPU against the cards of 2001" }
                    p {
                        "This page runs the arithmetic of early graphics cards on your GPU, in whole numbers, and \
                         compares every bit with the results of Crossbar's emulator, which the page contains. \
                         It also shows the results of your GPU's own floats."
                    }
                    p #status role="status" { "Waiting for the script. Without it the page shows stored pictures." }
                    dl #adapter {}
                    (arithmetic())
                    (live())
                    (programs())
                    (fixed_views(views))
                    (own::playground(emulator.is_some()))
                    @if emulator.is_some_and(|emulator| emulator.takes_shaders) { (own::shader()) }
                    (results())
                    p.provenance { "Crossbar " (version) ". The page loads nothing and sends nothing." }
                }
                script #data type="application/json" { (PreEscaped(json)) }
                @if let Some(emulator) = emulator {
                    script #emulator type="application/octet-stream" { (emulator.packed) }
                }
                script { (PreEscaped(script)) }
            }
        }
    };
    page.into_string()
}

fn arithmetic() -> Markup {
    html! {
        section aria-labelledby="integers" {
            h2 #integers { "Operations in each format, in whole numbers" }
            p {
                "Each cell counts the operand sets whose bits on your GPU differ from the emulator's. The count must \
                 be 0 everywhere, on every GPU, because only integers are used. A count above 0 links to the first \
                 operands that differ."
            }
            div.scroll tabindex="0" role="region" aria-label="Operations by formats" { table #cells {} }
            div #differences {}
            p { button #vectors type="button" disabled { "Save operands and results as a file" } }
        }
        section aria-labelledby="floats" {
            h2 #floats { "Your GPU's own floats" }
            p {
                "These tables use the same operands in the GPU's own arithmetic. They count results by their distance \
                 from the exact result rounded to nearest, in units in the last place (ULP), for normal operands and \
                 results. The last column says what WGSL requires."
            }
            div #native {}
        }
    }
}

fn live() -> Markup {
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
                @for (words, [r, g, b]) in PixelVerdict::VARIANTS.iter().rev().take(4).map(|v| (v.words(), v.color())) {
                    li { span.swatch aria-hidden="true" style=(format!("background:#{r:02x}{g:02x}{b:02x}")) {} (words) }
                }
            }
        }
    }
}

fn programs() -> Markup {
    html! {
        section aria-labelledby="programs" {
            h2 #programs { "Programs, instruction by instruction" }
            p {
                "These are pixel programs of the published systems, at one pixel. Every step that the emulator made is \
                 stored in the page; your GPU repeats it in whole numbers, and each bit is compared. The same program \
                 also runs on the same inputs in your GPU's own floats. Choose a pixel by mouse or arrow keys; on the \
                 listing, arrow keys step."
            }
            div.stand {
                div.chooser {
                    canvas #pixels tabindex="0" role="application" aria-label="Pixels: arrow keys choose one" aria-describedby="pixel-said" {}
                    p #pixel-said role="status" {}
                    form #program-controls aria-label="Program and registers" {}
                    p #about {}
                    p #program-verdict role="status" {}
                    p { button #save-case type="button" disabled { "Save as a case" } " for " code { "crossbar run --trace" } }
                }
                div #stepper tabindex="0" role="group" aria-label="Steps: arrow keys go back and forward" {
                    div.steps {
                        button #first type="button" disabled { "First" }
                        button #back type="button" disabled { "Back" }
                        button #forward type="button" disabled { "Forward" }
                        button #last type="button" disabled { "Last" }
                        button #parting type="button" disabled { "Where the floats first differ" }
                        output #step-of {}
                    }
                    ol #source aria-label="Source" {}
                    p #parting-said role="status" {}
                    (written())
                    div.scroll {
                        table {
                            caption { "Registers after the step" }
                            thead { tr { th scope="col" { "register" } @for c in ["x", "y", "z", "w"] { th scope="col" { (c) } } } }
                            tbody #registers {}
                        }
                    }
                }
            }
        }
    }
}

fn written() -> Markup {
    html! {
        div.scroll {
            table {
                caption #written-caption {}
                thead {
                    tr {
                        th rowspan="2" scope="col" { "register" }
                        th colspan="2" scope="colgroup" { "emulator" }
                        th scope="colgroup" { "your GPU" }
                        th colspan="3" scope="colgroup" { "your GPU's own floats" }
                    }
                    tr {
                        @for name in ["number", "bits", "bits", "number", "bits", "ULP apart"] { th scope="col" { (name) } }
                    }
                }
                tbody #written {}
            }
        }
    }
}

fn fixed_views(views: &[FixedView]) -> Markup {
    html! {
        section aria-labelledby="fixed" {
            h2 #fixed { "Fixed views, bit for bit" }
            p {
                "The emulator drew these pictures. Your GPU draws each of them again if it can; triangle and \
                 distance of every pixel must have the emulator's bits. All formats round to nearest; our Radeon 8500 \
                 computes in s3.12 rounded down, which leaks most: choose this rounding above."
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
            p { "All results as JSON, for a bug report or for comparison with another GPU." }
            textarea #json rows="8" readonly aria-label="Results as JSON" { "{}" }
            p { button #copy type="button" disabled { "Copy" } " " span #copied role="status" {} }
        }
    }
}
