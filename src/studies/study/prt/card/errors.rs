//! Errors of a card's picture: per pixel of its raster, by the step that causes them, and of variants, in which one
//! number format, map or target is changed at a time, and everything else is computed almost without rounding.

use crate::card::SeenPixel;
use crate::picture::metrics::{ErrorSums, value_error};
use crate::report::digits::{Quantity, shown};
use crate::report::words::{counted, percent};
use crate::report::{Cell, Findings, FoundTable, Table};

/// Number of steps between the codes of an 8-bit picture, from black to white.
pub(super) const STEPS: f64 = 255.0;

/// Errors of the pixels that show the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelErrors {
    /// RMS and largest difference of a channel, in steps of 1/255; infinite if a pixel is not finite.
    pub off_255ths: [f64; 2],
    /// Fraction of the pixels with a channel that is not finite, or whose error exceeds 1/255.
    pub visible: f64,
    /// Number of pixels that are not finite where the expected ones are, or the reverse.
    pub not_finite: u64,
    /// RMS over the finite pixels, in steps of 1/255.
    pub(super) finite_rms: f64,
}

impl PixelErrors {
    /// Compares pixels, row by row, with expected ones; pixels without a surface do not count.
    pub(super) fn of(seen: &[Option<SeenPixel>], found: &[[f64; 3]], expected: &[[f64; 3]]) -> Self {
        let shown = seen.iter().zip(found.iter().zip(expected)).filter(|(seen, _)| seen.is_some());
        let off: Vec<[f64; 3]> =
            shown.map(|(_, (a, b))| [0, 1, 2].map(|channel| STEPS * value_error(a[channel], b[channel]))).collect();
        let mut sums = ErrorSums::default();
        off.as_flattened().iter().for_each(|error| sums.add(*error, 1.0));
        let beyond = |limit: f64| off.iter().filter(|pixel| pixel.iter().any(|error| error.abs() > limit)).count();
        Self {
            off_255ths: [sums.rms(), sums.largest],
            visible: beyond(1.0) as f64 / off.len().max(1) as f64,
            not_finite: beyond(f64::MAX) as u64,
            finite_rms: sums.of_finite().rms(),
        }
    }

    /// Cells of a table: root mean square, largest, percent of the pixels.
    pub(super) fn cells(&self) -> [Cell; 3] {
        let [rms, largest] = self.off_255ths.map(Cell::measured);
        [rms, largest, Cell::percent(100.0 * self.visible)]
    }

    /// Sentence about the errors of the card, compared with the host's computation `from` the same numbers.
    pub(super) fn sentence(&self, card: &str, from: &str) -> String {
        let [rms, largest] = self.off_255ths.map(|steps| shown(steps, Quantity::Measured));
        let not_finite = match self.not_finite {
            0 => String::new(),
            count => format!(" {} not finite.", counted(count, "pixel is", "pixels are")),
        };
        format!(
            "{card}: off by {rms}/255 (root mean square; largest {largest}/255) from what the host computes in double \
             precision from {from}; {} of the pixels are off by more than 1/255.{not_finite}",
            percent(self.visible)
        )
    }
}

/// Clamps pixels as a fixed-point target does, if `is_clamped`.
pub(super) fn held(pixels: &[[f64; 3]], is_clamped: bool) -> Vec<[f64; 3]> {
    let held = |color: &[f64; 3]| if is_clamped { color.map(|value| value.clamp(0.0, 1.0)) } else { *color };
    pixels.iter().map(held).collect()
}

/// Axes whose rows are not single changes: the unchanged picture, and whole cards.
const NOT_ALONE: [&str; 2] = ["none", "card"];

const BLAME: &str = "Each row is the error of one step from light to picture, in steps of 1/255: the picture is \
    compared with the same picture in which that step is exact. The host computes all rows except the card's, in \
    double precision, at each pixel of the card's raster, from what is interpolated between vertices.";

/// A variant of a picture, with its errors.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureVariant {
    /// The varied setting.
    pub axis: &'static str,
    /// Its value.
    pub choice: String,
    /// Differences of pixels.
    pub errors: PixelErrors,
    /// Number of pixels with a channel below 0, if the drawing counts them.
    pub below_zero: Option<u64>,
}

/// Table with a row per variant; it has a column for pixels below 0 if a variant counts them.
pub fn variants_table(variants: &[PictureVariant]) -> Table {
    let counts = variants.iter().any(|variant| variant.below_zero.is_some());
    let last = if counts { "below_zero" } else { "" };
    let row = |PictureVariant { axis, choice, errors, below_zero }: &PictureVariant| {
        let [rms, largest, visible] = errors.cells();
        [(*axis).into(), choice.clone().into(), rms, largest, visible, (*below_zero).into()]
    };
    Table::of("What shows", &format!("what choice rms_255ths largest_255ths visible_% {last}"))
        .with(variants.iter().map(row))
}

/// The name with the largest root mean square error, and this error; `None` if all errors are 0.
fn worst<T>(of: impl Iterator<Item = (T, PixelErrors)>) -> Option<(T, String)> {
    let worst = of
        .filter(|(_, errors)| errors.off_255ths[0] > 0.0)
        .max_by(|(_, a), (_, b)| a.off_255ths[0].total_cmp(&b.off_255ths[0]));
    worst.map(|(name, errors)| (name, shown(errors.off_255ths[0], Quantity::Measured)))
}

/// Adds the table, the variant with the largest error, and the variants without visible errors.
pub(super) fn report_sweep(variants: &[PictureVariant], explained: &str, found: &mut Findings) {
    let alone = || variants.iter().filter(|variant| !NOT_ALONE.contains(&variant.axis));
    let name = |variant: &PictureVariant| format!("{} {}", variant.axis, variant.choice);
    let hidden: Vec<String> = alone().filter(|variant| variant.errors.visible == 0.0).map(name).collect();
    found.conclusion(if hidden.is_empty() {
        "Every change of the sweep is visible.".to_owned()
    } else {
        format!("Each of these changes, made alone, is not visible in any pixel: {}.", hidden.join("; "))
    });
    if let Some((name, rms)) = worst(alone().map(|variant| (name(variant), variant.errors))) {
        found.conclusion(format!("The change with the largest error is {name}: {rms}/255 (root mean square)."));
    }
    found.heading("What shows");
    found.explained_table(FoundTable::from(variants_table(variants)).csv("precision").field("precision"), explained);
}

/// Adds a row per step from light to picture with its error, and the step with the largest error.
pub(super) fn report_blame(blames: &[(&'static str, PixelErrors)], found: &mut Findings) {
    let row = |(step, errors): &(&'static str, PixelErrors)| [Cell::from(*step)].into_iter().chain(errors.cells());
    let table = Table::of("Error of the picture by step", "step rms_255ths largest_255ths visible_%")
        .with(blames.iter().map(row));
    if let Some((step, rms)) = worst(blames.iter().copied()) {
        found.conclusion(format!("The step with the largest error is {step}: {rms}/255 (root mean square)."));
    }
    found.heading("Error by step");
    found.explained_table(FoundTable::from(table).csv("blame").field("blame"), BLAME);
}
