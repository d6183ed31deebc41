//! "% GPU Rays" of Tables 2 and 4, which the text defines as "rays sent to the GPU": two interpretations.

use super::super::{Bound, Method, PaperFigure, PaperRow, Setting, Standing, Sweep};
use super::workload::TIMES;
use crate::ray_engine::engine::EngineCounts;
use crate::report::{Chart, Series, Table};

/// Interpretation: a fraction from 0 to 1.
type Reading = fn(&EngineCounts) -> f64;

/// Interpretations with their names.
const READINGS: [(&str, Reading); 2] = [
    // A ray that met the card at least once, among all rays.
    ("rays", EngineCounts::share_on_card),
    // A visit to a GPU cell's cache that ended on the card, among all visits; the others were forced to the host.
    ("visits", EngineCounts::share_of_visits_on_card),
];

/// Printed fraction with the counts of our run.
pub(super) struct Share<'a> {
    pub(super) what: &'a str,
    pub(super) printed: f64,
    pub(super) counts: &'a EngineCounts,
}

/// Rows by the first interpretation, explained by the second where that reaches them, and a table of both.
pub(super) fn rows(shares: &[Share<'_>], place: &'static str) -> (Vec<PaperRow>, Table) {
    let row = |share: &Share<'_>| {
        let target = PaperFigure::printed(share.printed, 0, "%", place);
        let what = format!("{}: rays on the card", share.what);
        PaperRow::new(
            what,
            (TIMES, Method::Engine),
            target,
            (100.0 * READINGS[0].1(share.counts), Standing::Counted),
            Bound::PREDICTION,
        )
    };
    let mut rows: Vec<PaperRow> = shares.iter().map(row).collect();
    let setting = |(at, of): (&str, Reading)| Setting {
        at: at.to_owned(),
        values: shares.iter().map(|share| 100.0 * of(share.counts)).collect(),
    };
    let sweep = Sweep {
        name: "what is called a ray on the card",
        parameter: "counted",
        settings: READINGS.map(setting).into(),
    };
    sweep.explain(&mut rows);
    let table = sweep.table(&format!("Two readings of the rays on the card, {place}"), &rows, (None, |share| share));
    (rows, table)
}

/// Chart of the printed fractions and both interpretations.
pub(super) fn chart(shares: &[Share<'_>], ticks: &[&str], title: &str) -> Chart {
    let points =
        |of: &dyn Fn(&Share<'_>) -> f64| (1..).zip(shares).map(|(x, share)| (f64::from(x), of(share))).collect();
    let [rays, visits] = READINGS.map(|(_, of)| points(&|share| 100.0 * of(share.counts)));
    Chart {
        title: title.to_owned(),
        y: "%".to_owned(),
        ticks: ticks.iter().map(ToString::to_string).collect(),
        dots: vec![
            Series { label: "rays that met the card".to_owned(), points: rays },
            Series { label: "visits of caches that ended on the card".to_owned(), points: visits },
        ],
        printed: points(&|share| share.printed),
        ..Chart::default()
    }
}
