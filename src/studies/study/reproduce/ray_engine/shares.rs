//! "% GPU Rays" of Tables 2 and 4, which the text defines as "rays sent to the GPU": two readings.

use super::workload::TIMES;
use super::{Dependence, Method, PaperRow, Setting, StudyError, Sweep, paper_row, printed};
use crate::ray_engine::engine::EngineCounts;
use crate::report::{Chart, Series, Table};

/// Reading: computes a fraction in [0, 1].
type Reading = fn(&EngineCounts) -> f64;

/// Readings with their names.
const READINGS: [(&str, Reading); 2] = [
    // Rays that met the card at least once, relative to all rays.
    ("rays", EngineCounts::share_on_card),
    // Visits to a GPU cell's cache that ended on the card, relative to all visits; the others were forced to the host.
    ("visits", EngineCounts::share_of_visits_on_card),
];

/// Name of a printed fraction, with the counts of our run.
pub(super) type Share<'a> = (&'static str, &'a EngineCounts);

/// Rows by the first reading, explained by the second if that reaches the printed values, and a table of both.
pub(super) fn rows(shares: &[Share<'_>], place: &str) -> Result<(Vec<PaperRow>, Table), StudyError> {
    let row = |&(id, counts): &Share<'_>| {
        paper_row(id, (TIMES, Method::Engine), (100.0 * READINGS[0].1(counts), Dependence::Counted))
    };
    let mut rows: Vec<PaperRow> = shares.iter().map(row).collect::<Result<_, _>>()?;
    let setting = |(at, of): (&str, Reading)| Setting {
        at: at.to_owned(),
        values: shares.iter().map(|(_, counts)| 100.0 * of(counts)).collect(),
    };
    let sweep =
        Sweep { name: "definition of a ray on the card", parameter: "counted", settings: READINGS.map(setting).into() };
    sweep.explain(&mut rows);
    let table =
        sweep.table(&format!("Share of rays on the card by two readings, {place}"), &rows, (None, |share| share));
    Ok((rows, table))
}

/// Chart of the printed fractions and of both readings.
pub(super) fn chart(shares: &[Share<'_>], ticks: &[&str], title: &str) -> Result<Chart, StudyError> {
    let points = |values: Vec<f64>| (1..).zip(values).map(|(x, value)| (f64::from(x), value)).collect();
    let [rays, visits] = READINGS.map(|(_, of)| points(shares.iter().map(|(_, counts)| 100.0 * of(counts)).collect()));
    let values: Vec<f64> = shares.iter().map(|(id, _)| Ok(printed(id)?.value)).collect::<Result<_, StudyError>>()?;
    Ok(Chart {
        title: title.to_owned(),
        y: "%".to_owned(),
        ticks: ticks.iter().map(ToString::to_string).collect(),
        dots: vec![
            Series { label: "rays that met the card".to_owned(), points: rays },
            Series { label: "cache visits that ended on the card".to_owned(), points: visits },
        ],
        printed: vec![Series { label: "printed".to_owned(), points: points(values) }],
        ..Chart::default()
    })
}
