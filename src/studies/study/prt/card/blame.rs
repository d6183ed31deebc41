//! Errors of a picture by step on the way from light to pixels.

use super::difference::PixelErrors;
use crate::report::digits::{Quantity, shown};
use crate::report::{Findings, FoundTable, Table};

const BLAME: &str = "Each row is one step of the way from light to picture against the same picture with that step \
    exact, in 255ths of white. All rows but the card's are computed by the host in double precision, pixel by pixel of the card's \
    raster, from what is interpolated between vertices.";

/// Error of one step.
pub(super) struct Blame {
    pub(super) step: &'static str,
    pub(super) errors: PixelErrors,
}

/// Adds a row per step, and the step with the largest error.
pub(super) fn report_blame(blames: &[Blame], found: &mut Findings) {
    let mut table = Table::of("What the picture is off by", "step rms_255ths largest_255ths visible_%");
    for blame in blames {
        let [rms, largest, visible] = blame.errors.cells();
        table.push([blame.step.into(), rms, largest, visible]);
    }
    if let Some(worst) = blames.iter().max_by(|a, b| a.errors.off_255ths[0].total_cmp(&b.errors.off_255ths[0])) {
        let rms = shown(worst.errors.off_255ths[0], Quantity::Measured);
        found.conclusion(format!("Most is to blame on this: {}, {rms} 255ths root mean square.", worst.step));
    }
    found.heading("What is to blame");
    found.explained_table(FoundTable::from(table).csv("blame").field("blame"), BLAME);
}
