//! False-color pictures with colormaps suitable for all kinds of color vision, with a color bar.

use colorous::{Gradient, MAGMA, RED_BLUE};

use super::NamedPicture;
use super::digits::{Quantity, shown};
use crate::picture::{RgbImage, rgb8};

/// Colors of values that are not finite; the gradients contain neither.
const NOT_FINITE: [u8; 3] = [0, 0, 0];
const NOT_FINITE_MAGNITUDE: [u8; 3] = [0, 158, 115];

/// Suffix for the caption of a [`signed`] picture: explains black pixels; empty if all values are finite.
pub fn not_finite(values: &[f64]) -> &'static str {
    if values.iter().all(|value| value.is_finite()) { "" } else { "; black where not finite" }
}

/// Maps signed numbers to colors, rows from the top: from blue at `-scale` or below through white at 0 to red at
/// `scale` or above; black if not finite. Below the picture, a color bar runs from `-scale` on the left to `scale` on
/// the right.
pub fn signed(width: u32, values: &[f64], scale: f64) -> RgbImage {
    with_bar(width, values, (RED_BLUE, NOT_FINITE), |value| 0.5 - 0.5 * value / scale)
}

/// Maps numbers in [0, 1] to colors, rows from the top: from black through purple and orange to a pale yellow; green if
/// not finite. Below the picture, a color bar runs from 0 on the left to 1 on the right.
pub fn magnitude(width: u32, values: &[f64]) -> RgbImage {
    with_bar(width, values, (MAGMA, NOT_FINITE_MAGNITUDE), |value| value)
}

/// Pictures `LABEL-error` of signed relative errors, as by [`signed`] and all on one scale; none if all errors are 0.
/// `caption` writes a caption from a label and from the ends of the scale in percent.
pub fn errors(
    width: u32,
    errors: &[(&str, impl AsRef<[f64]>)],
    caption: impl Fn(&str, &str) -> String,
) -> Vec<NamedPicture> {
    let finite = errors.iter().flat_map(|(_, error)| error.as_ref()).filter(|error| error.is_finite());
    let scale = finite.fold(0.0, |most: f64, error| most.max(error.abs()));
    let ends = shown(100.0 * scale, Quantity::Percent);
    let picture = |(label, error): &(&str, _)| {
        let error: &[f64] = AsRef::as_ref(error);
        let caption = caption(label, &ends) + not_finite(error);
        NamedPicture::new(format!("{label}-error"), signed(width, error, scale), caption)
    };
    if scale == 0.0 { Vec::new() } else { errors.iter().map(picture).collect() }
}

fn with_bar(
    width: u32,
    values: &[f64],
    (gradient, not_finite): (Gradient, [u8; 3]),
    place: impl Fn(f64) -> f64,
) -> RgbImage {
    let color = |at: f64| gradient.eval_continuous(at.clamp(0.0, 1.0)).as_array();
    let rows = values.len() as u32 / width.max(1);
    // Tall enough to be read below a wide picture, too.
    let bar = (rows / 24).max(width / 40).max(2);
    let pixel = |value: &f64| if value.is_finite() { color(place(*value)) } else { not_finite };
    // The right end of a signed scale is the left end of its gradient.
    let [left, right] = [place(0.0).min(1.0), place(1.0)];
    let rises = right > left;
    let along = move |x: u32| (f64::from(x) + 0.5) / f64::from(width);
    let bar = (0..bar * width).map(|at| along(at % width)).map(move |t| color(if rises { t } else { 1.0 - t }));
    let gap = std::iter::repeat_n([255; 3], width as usize);
    rgb8(width, rows + 1 + bar.len() as u32 / width.max(1), values.iter().map(pixel).chain(gap).chain(bar))
}
