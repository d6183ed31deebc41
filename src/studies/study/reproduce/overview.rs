//! Overview of all rows: conclusion, tally, and a chart of our values relative to the papers'.

use strum::VariantArray as _;

use super::{EntryChart, MissClass, PaperRow, Prose, Reproduced, RowSource, RowVerdict, Standing, number};
use crate::report::{Chart, Findings, NamedChart, Scale, Series, TallyEntry, Tone};

const JUDGED: &str = "Of {} figures that chose no constant, {} are predicted within bounds in numbers, {} are met in order only, and {} are \
    the paper's own values set against each other; {} are explained, {} missed, and {} contradicted by their own paper.";
const ROUNDED: &str = "{} of those that are met need the rounding of the printed value.";
const MISSED: &str = "Missed for what is in the way: {}.";
const CALIBRATED: &str = "{} more chose a constant of a model and are no evidence; missed all the same: {}.";
const RECORDED: &str = "{} are recorded at full size, {} of them computed anew with the same bits.";
const REDUCED: &str = "{} more have reduced models alone and are not judged.";
const DIFFER: &str = "Not as recorded: {}.";
const FARTHEST: &str = "Farthest from print: {} ({}, {}), {} times the paper's.";

/// Adds conclusion and tally to the findings.
pub(super) fn overview(all: &mut Findings, found: &Reproduced) {
    let all_rows: Vec<&PaperRow> = found.iter().flat_map(|(_, found)| &found.rows).collect();
    let rows: Vec<&PaperRow> = found.iter().flat_map(|(_, found)| found.counted()).collect();
    let sentences = [
        judged(&rows),
        differ(&rows),
        classes(&rows),
        recorded(&all_rows),
        reduced(&all_rows),
        rounded(&rows),
        calibrated(&rows),
        farthest(&rows),
    ];
    for sentence in sentences.into_iter().flatten() {
        all.conclusion(sentence.to_string());
    }
    for entry in tally(&rows) {
        all.tally(entry.count, [&entry.what, &entry.what], entry.tone);
    }
}

/// Counts of all verdicts, in their order.
pub(super) fn tally(rows: &[&PaperRow]) -> Vec<TallyEntry> {
    let entry = |verdict: &RowVerdict| TallyEntry {
        count: count(rows, |row| row.verdict() == *verdict) as u64,
        what: verdict.to_string(),
        tone: tone(*verdict),
    };
    RowVerdict::counted().map(|verdict| entry(&verdict)).collect()
}

/// Adds the chart of all rows to the findings.
pub(super) fn overview_chart(all: &mut Findings, found: &Reproduced) {
    let rows: Vec<&PaperRow> = found.iter().flat_map(|(_, found)| &found.rows).collect();
    if let Some(EntryChart { name, chart, caption }) = chart(&rows) {
        all.chart(NamedChart { name: name.to_owned(), chart, caption: caption.to_string() });
    }
}

const fn tone(verdict: RowVerdict) -> Tone {
    match verdict {
        RowVerdict::Predicted => Tone::Good,
        RowVerdict::Missed => Tone::Bad,
        RowVerdict::OrderOnly
        | RowVerdict::Consistent
        | RowVerdict::Calibrated
        | RowVerdict::Explained
        | RowVerdict::Contradictory
        | RowVerdict::TooVague
        | RowVerdict::Reduced => Tone::Neutral,
    }
}

fn count(rows: &[&PaperRow], of: impl Fn(&PaperRow) -> bool) -> usize {
    rows.iter().filter(|row| of(row)).count()
}

const fn chose_a_constant(row: &PaperRow) -> bool {
    matches!(row.standing, Standing::Calibrated { .. })
}

fn judged(rows: &[&PaperRow]) -> Option<Prose> {
    let of = |verdict: RowVerdict| count(rows, |row| !chose_a_constant(row) && row.verdict() == verdict);
    let verdicts = [
        RowVerdict::Predicted,
        RowVerdict::OrderOnly,
        RowVerdict::Consistent,
        RowVerdict::Explained,
        RowVerdict::Missed,
        RowVerdict::Contradictory,
    ];
    let judged = count(rows, |row| !chose_a_constant(row));
    let figures = std::iter::once(judged).chain(verdicts.map(of));
    (judged > 0).then(|| Prose::new(JUDGED, figures.map(|figure| figure.to_string())))
}

/// Number of missed rows by class.
fn classes(rows: &[&PaperRow]) -> Option<Prose> {
    let of = |class: MissClass| (count(rows, |row| row.missed() == Some(class)), class);
    let counts = MissClass::VARIANTS.iter().copied().map(of).filter(|(count, _)| *count > 0);
    let counts: Vec<String> = counts.map(|(count, class)| format!("{class} {count}")).collect();
    (!counts.is_empty()).then(|| Prose::new(MISSED, [counts.join(", ")]))
}

/// Numbers of rows by the run that they are from, where one is not this run.
fn recorded(rows: &[&PaperRow]) -> Option<Prose> {
    let confirmed = count(rows, |row| row.source == RowSource::Confirmed);
    let recorded = count(rows, |row| matches!(row.source, RowSource::Recorded { .. } | RowSource::Differs { .. }));
    let counts = [confirmed + recorded, confirmed];
    (counts != [0; 2]).then(|| Prose::new(RECORDED, counts.map(|count| count.to_string())))
}

fn reduced(rows: &[&PaperRow]) -> Option<Prose> {
    let reduced = count(rows, |row| row.verdict() == RowVerdict::Reduced);
    (reduced > 0).then(|| Prose::new(REDUCED, [reduced.to_string()]))
}

/// Names of the rows that are not as recorded.
fn differ(rows: &[&PaperRow]) -> Option<Prose> {
    let differ = rows.iter().filter(|row| matches!(row.source, RowSource::Differs { .. }));
    let names: Vec<&str> = differ.map(|row| row.target.id.as_str()).collect();
    (!names.is_empty()).then(|| Prose::new(DIFFER, [names.join(", ")]))
}

fn rounded(rows: &[&PaperRow]) -> Option<Prose> {
    let all = count(rows, |row| row.contradiction().is_none() && row.holds_by_rounding());
    (all > 0).then(|| Prose::new(ROUNDED, [all.to_string()]))
}

fn calibrated(rows: &[&PaperRow]) -> Option<Prose> {
    let all = count(rows, chose_a_constant);
    let missed = count(rows, |row| chose_a_constant(row) && row.verdict() == RowVerdict::Missed);
    (all > 0).then(|| Prose::new(CALIBRATED, [all, missed].map(|figure| figure.to_string())))
}

/// Ratio of our value and the printed one, inverted if necessary so that it is at least 1; `None` for a value that is
/// not above 0.
fn distance(row: &PaperRow) -> Option<f64> {
    let ratio = ratio(row);
    (ratio > 0.0 && ratio.is_finite()).then(|| ratio.max(1.0 / ratio))
}

fn ratio(row: &PaperRow) -> f64 {
    row.ours / row.target.value
}

fn farthest(rows: &[&PaperRow]) -> Option<Prose> {
    let missed = rows.iter().filter(|row| row.verdict() == RowVerdict::Missed);
    let (row, _) = missed.filter_map(|row| Some((row, distance(row)?))).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let figures = [row.target.what.clone(), row.device.to_owned(), row.target.place.clone(), number(ratio(row), 2)];
    Some(Prose::new(FARTHEST, figures))
}

/// Verdicts in the order of the chart: the first two have the colors of the tally.
const ORDER: [RowVerdict; 8] = [
    RowVerdict::Predicted,
    RowVerdict::Missed,
    RowVerdict::OrderOnly,
    RowVerdict::Consistent,
    RowVerdict::Calibrated,
    RowVerdict::Explained,
    RowVerdict::Contradictory,
    RowVerdict::TooVague,
];

/// Chart of our values relative to the papers', a point per row, in the order of `rows.csv`; `None` for fewer than two
/// rows that can be shown.
fn chart(rows: &[&PaperRow]) -> Option<EntryChart> {
    let point = |(n, row): (usize, &&PaperRow)| ((n + 1) as f64, ratio(row));
    let of = |verdict: RowVerdict| Series {
        label: verdict.to_string(),
        points: rows.iter().enumerate().filter(|(_, row)| row.verdict() == verdict).map(point).collect(),
    };
    let drawn = rows.iter().filter(|row| row.verdict() != RowVerdict::Reduced && distance(row).is_some()).count();
    (drawn > 1).then(|| EntryChart {
        name: "overview",
        chart: Chart {
            title: "Ours over the paper's, row by row".to_owned(),
            x: "row of rows.csv".to_owned(),
            y: "ours / paper's".to_owned(),
            y_scale: Scale::Logarithmic,
            dots: ORDER.map(of).into(),
            ..Chart::default()
        },
        caption: "Each row's value over the paper's. Bounds differ from row to row: the tables have them.".into(),
    })
}
