//! "% GPU Rays" of Tables 2 and 4, which the text defines as "rays sent to the GPU": two readings.

use super::workload::TIMES;
use super::{Dependence, Method, PaperRow, Setting, StudyError, Sweep, paper_row, printed_value};
use crate::ray_engine::engine::EngineCounts;
use crate::report::{Chart, Series, Table};

/// A reading with its name; it computes a fraction in [0, 1].
type ShareReading = (&'static str, fn(&EngineCounts) -> f64);

const READINGS: [ShareReading; 2] = [
    // Rays that met the card at least once, relative to all rays.
    ("rays", EngineCounts::share_on_card),
    // Visits to a GPU cell's cache that ended on the card, relative to all visits; the others were forced to the host.
    ("visits", EngineCounts::share_of_visits_on_card),
];

/// Name of a printed fraction after `ray-engine/share-`, with the counts of our run.
pub(super) type Share<'a> = (&'static str, &'a EngineCounts);

/// Rows by the first reading, explained by the second if that reaches the printed values, and a table of both.
pub(super) fn rows(shares: &[Share<'_>], place: &str) -> Result<(Vec<PaperRow>, Table), StudyError> {
    let row = |&(id, counts): &Share<'_>| {
        let ours = (100.0 * READINGS[0].1(counts), Dependence::Counted);
        paper_row(&format!("ray-engine/share-{id}"), (TIMES, Method::Engine), ours)
    };
    let mut rows: Vec<PaperRow> = shares.iter().map(row).collect::<Result<_, _>>()?;
    let settings = READINGS.map(|(at, _)| at).into_iter().zip(percents(shares));
    let settings = settings.map(|(at, values)| Setting { at: at.to_owned(), values }).collect();
    let sweep = Sweep { name: "definition of a ray on the card", parameter: "counted", settings };
    sweep.explain(&mut rows);
    let title = format!("Share of rays on the card by two readings, {place}");
    let table = sweep.table(&title, &rows, (None, |share| share));
    Ok((rows, table))
}

fn percents(shares: &[Share<'_>]) -> [Vec<f64>; 2] {
    READINGS.map(|(_, of)| shares.iter().map(|(_, counts)| 100.0 * of(counts)).collect())
}

pub(super) fn chart(shares: &[Share<'_>], ticks: &[&str], title: &str) -> Result<Chart, StudyError> {
    let series = |label: &str, values: Vec<f64>| Series {
        label: label.to_owned(),
        points: (1..).zip(values).map(|(x, value)| (f64::from(x), value)).collect(),
    };
    let [rays, visits] = percents(shares);
    let printed = shares.iter().map(|(id, _)| printed_value(&format!("ray-engine/share-{id}")));
    Ok(Chart {
        title: title.to_owned(),
        y: "%".to_owned(),
        ticks: ticks.iter().map(ToString::to_string).collect(),
        dots: vec![series("rays that met the card", rays), series("cache visits that ended on the card", visits)],
        printed: vec![series("printed", printed.collect::<Result<_, _>>()?)],
        ..Chart::default()
    })
}
