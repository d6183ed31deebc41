//! Pictures and charts of a page.

use std::ops::Range;

use base64::{Engine as _, engine::general_purpose::STANDARD};
use maud::{Markup, PreEscaped, html};

use super::super::NamedPicture;

/// Width in pixels up to which a picture is enlarged by a whole factor, and the largest factor.
const SMALL: u32 = 320;
const LARGEST: u32 = 8;
const ZOOMED: u32 = 1200;

/// Renders a chart; the SVG is our own and inserted unescaped.
pub(super) fn drawing(svg: &str, caption: &str) -> Markup {
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
pub(super) fn pictures(all: &[NamedPicture], pngs: &[Vec<u8>], places: Range<usize>) -> Markup {
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
