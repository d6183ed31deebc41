//! Errors of a picture by the step that causes them, and of variants: one number format, map or target is changed at a
//! time, and everything else is computed almost without rounding.

use super::difference::PixelErrors;
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, Table};

/// Axes whose rows are not single changes: the unchanged picture, and whole cards.
const NOT_ALONE: [&str; 2] = ["none", "card"];

const BLAME: &str = "Each row is the error of one step from light to picture, in 255ths of white: the picture against \
    the same picture with that step exact. All rows but the card's are computed by the host in double precision, pixel \
    by pixel of the card's raster, from what is interpolated between vertices.";

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

/// The name with the largest root mean square error, and this error.
fn worst<T>(of: impl Iterator<Item = (T, PixelErrors)>) -> Option<(T, String)> {
    let worst = of.max_by(|(_, a), (_, b)| a.off_255ths[0].total_cmp(&b.off_255ths[0]));
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
        format!("Changes that are visible in no pixel, each alone: {}.", hidden.join("; "))
    });
    if let Some((name, rms)) = worst(alone().map(|variant| (name(variant), variant.errors))) {
        found.conclusion(format!("The largest error is that of {name}: {rms} 255ths root mean square."));
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
        found.conclusion(format!("The largest error is that of this step: {step}, {rms} 255ths root mean square."));
    }
    found.heading("Error by step");
    found.explained_table(FoundTable::from(table).csv("blame").field("blame"), BLAME);
}
