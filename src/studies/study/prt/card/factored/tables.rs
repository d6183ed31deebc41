//! The tables of the study.

use crate::report::digits::{Quantity, shown};
use crate::report::{Findings, FoundTable, Table};
use crate::study::prt::card::difference::PixelErrors;

pub(super) const TIME: &str = "Modelled, not measured: the pipeline model of the card beside a host that multiplies and adds as \
    fast as the frames of the paper's Table 1 say. A frame follows a frame, so that host and card work side by side.";
const BLAME: &str = "Each row is one step of the way from light to picture against the same picture with that step \
    exact, in 255ths of white. All rows but the card's are computed by the host in double precision, pixel by pixel of the card's \
    raster, from what is interpolated between vertices.";

/// What a step on the way to the picture costs.
pub(in crate::study::prt::card) struct Blame {
    pub(in crate::study::prt::card) step: &'static str,
    pub(in crate::study::prt::card) errors: PixelErrors,
}

pub(in crate::study::prt::card) fn report_blame(blames: &[Blame], found: &mut Findings) {
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
