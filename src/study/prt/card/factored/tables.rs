//! The tables of the study.

use super::pixels::PixelErrors;
use crate::prt::on_card::time::FrameTime;
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, Table};

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

/// The parts of a frame.
pub(super) fn times(time: &FrameTime) -> Table {
    let mut table = Table::new("A frame", &["part", "ms"]);
    let parts = [
        ("frame to frame", time.frame),
        ("host at work", time.host),
        ("products on the host", time.products),
        ("vertices on their way", time.uploads),
        ("state and constants", time.state),
        ("draws", time.draws),
    ];
    parts.into_iter().for_each(|(part, time)| table.push([part.into(), Cell::measured(1e3 * time.seconds())]));
    table
}

pub(super) fn time_sentence(time: &FrameTime, card: &str) -> String {
    let rate = shown(time.per_second(), Quantity::Measured);
    let waits = time.bottleneck.map_or_else(String::new, |bottleneck| format!(", whose draws wait for {bottleneck}"));
    format!("{card}: modelled {rate} frames a second{waits}.")
}
