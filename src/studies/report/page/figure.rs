//! Pictures and charts of a page.

use std::ops::Range;

use base64::{Engine as _, engine::general_purpose::STANDARD};
use maud::{Markup, PreEscaped, html};

use super::super::{NamedPicture, ReportError};
use crate::picture::png;

/// Widths of pictures on a page, in pixels: on a phone, and two side by side on a screen.
const WIDTHS: [(&str, u32); 2] = [("narrow", 340), ("wide", 600)];

/// One size of a picture: its reduction factor, its place, and its file.
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

/// Renders pictures side by side at their native resolution; larger ones are reduced by a whole factor, and shown in
/// full when clicked.
pub(super) fn pictures(all: &[NamedPicture], pngs: &[Vec<u8>], places: Range<usize>) -> Result<Markup, ReportError> {
    let figures: Vec<Markup> =
        places.map(|place| figure(&all[place], &pngs[place], place)).collect::<Result<_, _>>()?;
    Ok(html! { div.figures { @for figure in figures { (figure) } } })
}

fn figure(picture: &NamedPicture, full: &[u8], place: usize) -> Result<Markup, ReportError> {
    let sizes = sizes(picture, full)?;
    let images = html! {
        @for SizedPicture { pixels: (width, height), classes, source, .. } in &sizes {
            img class=[(sizes.len() > 1).then_some(classes)] src=(source) alt=(picture.caption) width=(width) height=(height);
        }
    };
    let (id, caption) = (format!("picture-{place}"), format!("caption-{place}"));
    Ok(html! {
        @if sizes.len() > 1 {
            figure.picture.zoom id=(id) {
                a.close href=(format!("#{caption}")) { "Back to the page" }
                div.frame { a href=(format!("#{id}")) title="All pixels" { (images) } }
                figcaption id=(caption) { (picture.caption) (notes(picture, &sizes)) }
            }
        } @else {
            figure.picture { div.frame { (images) } figcaption { (picture.caption) } }
        }
    })
}

/// Returns each size that some place requires, once; the last is the picture itself.
fn sizes(picture: &NamedPicture, full: &[u8]) -> Result<Vec<SizedPicture>, ReportError> {
    let wanted = WIDTHS.map(|(class, width)| (class, picture.reduction(width)));
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
                    pixels: image.dimensions(),
                    classes: format!("size {class}"),
                    source: format!("data:image/png;base64,{source}"),
                });
            }
        }
    }
    Ok(sizes)
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
