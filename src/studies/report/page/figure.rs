//! Pictures and charts of a page.

use std::ops::Range;

use base64::{Engine as _, engine::general_purpose::STANDARD};
use maud::{Markup, PreEscaped, html};

use super::super::NamedPicture;
use crate::error::InputError;
use crate::picture::png;

/// Width of a page's text on a screen of 1280 pixels, and the gap between pictures, in pixels.
const PAGE: u32 = 1226;
const GAP: u32 = 20;
/// Most pictures side by side on a screen.
const ABREAST: u32 = 3;
/// Width of a picture that is shown alone, in pixels.
const ZOOMED: u32 = 1200;
/// Width up to which a smaller picture is enlarged by a whole factor, and the largest factor.
const SMALL: u32 = 320;
const LARGEST: u32 = 8;

/// Places of one picture of `count` on a page and their widths in pixels: on a phone and in a narrow window one below
/// the other, on a screen side by side.
fn widths(count: usize) -> [(&'static str, u32); 3] {
    let abreast = u32::try_from(count).unwrap_or(ABREAST).clamp(1, ABREAST);
    [("narrow", 340), ("middle", 560), ("wide", (PAGE - GAP * (abreast - 1)) / abreast)]
}

/// One size of a picture: its reduction factor, its size on the page, its place, and its file.
struct SizedPicture {
    factor: u32,
    pixels: (u32, u32),
    classes: String,
    source: String,
}

/// Renders a chart; the SVG is our own and inserted unescaped.
pub(super) fn drawing(svg: &str, caption: &str) -> Markup {
    html! {
        figure.drawing {
            div.frame tabindex="0" role="region" aria-label=(caption) { (PreEscaped(svg)) }
            figcaption { (caption) }
        }
    }
}

/// Renders pictures side by side at their native resolution; larger ones are reduced by a whole factor. A click shows
/// all pixels, enlarged by a whole factor. The script adds a slider between pictures of the same size.
pub(super) fn pictures(all: &[NamedPicture], pngs: &[Vec<u8>], places: Range<usize>) -> Result<Markup, InputError> {
    let count = places.len();
    let figures: Vec<Markup> =
        places.map(|place| figure(&all[place], &pngs[place], (place, count))).collect::<Result<_, _>>()?;
    Ok(html! { div.figures { @for figure in figures { (figure) } } })
}

fn figure(picture: &NamedPicture, full: &[u8], (place, count): (usize, usize)) -> Result<Markup, InputError> {
    let sizes = sizes(picture, full, count)?;
    let (id, caption) = (format!("picture-{place}"), format!("caption-{place}"));
    let width = picture.image.width();
    let zoomed = width * (ZOOMED / width.max(1)).max(1);
    Ok(html! {
        figure.picture id=(id) style=(format!("--zoomed: {zoomed}px")) {
            a.close href=(format!("#{caption}")) { "Back to the page" }
            div.frame {
                a href=(format!("#{id}")) title="All pixels" {
                    @for SizedPicture { pixels: (width, height), classes, source, .. } in &sizes {
                        img class=(classes) src=(source) alt=(picture.caption) width=(width) height=(height);
                    }
                }
            }
            figcaption id=(caption) { (picture.caption) (notes(picture, &sizes)) }
        }
    })
}

/// Returns each size that some place requires, once; the last is the picture itself.
fn sizes(picture: &NamedPicture, full: &[u8], count: usize) -> Result<Vec<SizedPicture>, InputError> {
    let wanted = widths(count).map(|(class, width)| (class, picture.reduction(width)));
    let mut sizes: Vec<SizedPicture> = Vec::new();
    for (class, factor) in wanted.into_iter().chain([("full", 1)]) {
        match sizes.iter_mut().find(|size| size.factor == factor) {
            Some(size) => {
                size.classes.push(' ');
                size.classes.push_str(class);
            }
            None => {
                let image = picture.reduced(factor);
                let reduced = if factor > 1 { Some(png(&image)?) } else { None };
                let source = STANDARD.encode(reduced.as_deref().unwrap_or(full));
                sizes.push(SizedPicture {
                    factor,
                    pixels: enlarged(image.dimensions()),
                    classes: format!("size {class}"),
                    source: format!("data:image/png;base64,{source}"),
                });
            }
        }
    }
    Ok(sizes)
}

/// Size at which a picture is shown: one of few pixels, enlarged by a whole factor.
fn enlarged((width, height): (u32, u32)) -> (u32, u32) {
    let factor = (SMALL / width.max(1)).clamp(1, LARGEST);
    (factor * width, factor * height)
}

/// Notes on which pixels a reduced picture shows.
fn notes(picture: &NamedPicture, sizes: &[SizedPicture]) -> Markup {
    let which = if picture.ranks.is_empty() { "the middle one" } else { "the worst" };
    html! {
        @for SizedPicture { factor, classes, .. } in sizes.iter().filter(|size| size.factor > 1) {
            span class=(format!("note {classes}")) { "Of each " (factor) " x " (factor) " pixels " (which) " is shown; click for all." }
        }
    }
}
