//! Varies one number format, map or target at a time; everything else is computed almost without rounding.

use super::difference::PixelErrors;
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, Table};

/// Axes whose rows are not single changes: the unchanged picture, and whole cards.
const NOT_ALONE: [&str; 2] = ["none", "card"];

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
    let mut table = Table::of("What shows", &format!("what choice rms_255ths largest_255ths visible_% {last}"));
    for PictureVariant { axis, choice, errors, below_zero } in variants {
        let [rms, largest, visible] = errors.cells();
        let below_zero = below_zero.map_or(Cell::Empty, Cell::from);
        table.push([(*axis).into(), choice.clone().into(), rms, largest, visible, below_zero]);
    }
    table
}

/// Adds the table, the variant with the largest error, and the variants without visible errors.
pub(super) fn report_sweep(variants: &[PictureVariant], explained: &'static str, found: &mut Findings) {
    let alone = || variants.iter().filter(|variant| !NOT_ALONE.contains(&variant.axis));
    let name = |variant: &PictureVariant| format!("{} {}", variant.axis, variant.choice);
    let hidden: Vec<String> = alone().filter(|variant| variant.errors.visible == 0.0).map(name).collect();
    found.conclusion(if hidden.is_empty() {
        "Every change of the sweep is visible.".to_owned()
    } else {
        format!("Changes that are visible in no pixel, each alone: {}.", hidden.join("; "))
    });
    if let Some(worst) = alone().max_by(|a, b| a.errors.off_255ths[0].total_cmp(&b.errors.off_255ths[0])) {
        let rms = shown(worst.errors.off_255ths[0], Quantity::Measured);
        found.conclusion(format!("The largest error is that of {}: {rms} 255ths root mean square.", name(worst)));
    }
    found.heading("What shows");
    found.explained_table(FoundTable::from(variants_table(variants)).csv("precision").field("precision"), explained);
}
