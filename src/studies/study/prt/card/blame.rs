//! Errors of a picture by the step, from light to pixels, that causes them.

use super::difference::PixelErrors;
use crate::report::digits::{Quantity, shown};
use crate::report::{Findings, FoundTable, Table};

const BLAME: &str = "Each row is the error of one step from light to picture, in 255ths of white: the picture against \
    the same picture with that step exact. All rows but the card's are computed by the host in double precision, pixel \
    by pixel of the card's raster, from what is interpolated between vertices.";

/// Error of one step.
pub(super) struct Blame {
    pub(super) step: &'static str,
    pub(super) errors: PixelErrors,
}

/// Adds a row per step, and the step with the largest error.
pub(super) fn report_blame(blames: &[Blame], found: &mut Findings) {
    let mut table = Table::of("Error of the picture by step", "step rms_255ths largest_255ths visible_%");
    for blame in blames {
        let [rms, largest, visible] = blame.errors.cells();
        table.push([blame.step.into(), rms, largest, visible]);
    }
    if let Some(worst) = blames.iter().max_by(|a, b| a.errors.off_255ths[0].total_cmp(&b.errors.off_255ths[0])) {
        let rms = shown(worst.errors.off_255ths[0], Quantity::Measured);
        found.conclusion(format!(
            "The largest error is that of this step: {}, {rms} 255ths root mean square.",
            worst.step
        ));
    }
    found.heading("Error by step");
    found.explained_table(FoundTable::from(table).csv("blame").field("blame"), BLAME);
}
