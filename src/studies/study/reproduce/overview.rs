//! Overview of all rows: conclusion, tally, and a chart of our values relative to the papers'.

use strum::VariantArray as _;

use super::{EntryChart, MissClass, PaperRow, Prose, Reproduced, RowSource, RowVerdict, Standing, number};
use crate::report::words::listed;
use crate::report::{Chart, Findings, NamedChart, Scale, Series, TallyEntry, Tone};

const JUDGED: &str = "Of {} figures that chose no constant: {}.";
const ROUNDED: &str = "{} of those that are met need the rounding of the printed value.";
const MISSED: &str = "Missed for what is in the way: {}.";
const CALIBRATED: &str = "{} more chose a constant of a model and are no evidence; missed all the same: {}.";
const RECORDED: &str = "Of these, {} are recorded at full size, {} of them computed anew with the same bits.";
const REDUCED: &str = "{} more have reduced models alone and are not judged.";
const DIFFER: &str = "Not as recorded: {}.";
const FARTHEST: &str = "Farthest from print: {} ({}, {}), {} times the paper's.";

/// Adds conclusion and tally to the findings.
pub(super) fn overview(all: &mut Findings, found: &Reproduced) {
    let all_rows: Vec<&PaperRow> = found.iter().flat_map(|(_, found)| &found.rows).collect();
    let rows: Vec<&PaperRow> = found.iter().flat_map(|(_, found)| found.counted()).collect();
    let evidence = chose_none(found);
    let sentences = [
        judged(&evidence),
        differ(&rows),
        classes(&evidence),
        recorded(&evidence),
        reduced(&all_rows),
        rounded(&evidence),
        calibrated(&rows),
        farthest(&evidence),
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
        | RowVerdict::ByConstruction
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

/// Counted rows that chose no constant: all sentences but that on calibrated rows are of these.
pub(super) fn chose_none(found: &Reproduced) -> Vec<&PaperRow> {
    found.iter().flat_map(|(_, found)| found.counted()).filter(|row| !chose_a_constant(row)).collect()
}

/// Numbers of rows by verdict, in words, without those that are 0. Their sum is the number of rows.
pub(super) fn parts(rows: &[&PaperRow]) -> String {
    let of = |verdict: RowVerdict| (count(rows, |row| row.verdict() == verdict), verdict);
    let counts = RowVerdict::counted().map(of).filter(|(count, _)| *count > 0);
    listed(&counts.map(|(count, verdict)| format!("{count} {}", verdict.of_rows())).collect::<Vec<_>>())
}

fn judged(rows: &[&PaperRow]) -> Option<Prose> {
    (!rows.is_empty()).then(|| Prose::new(JUDGED, [rows.len().to_string(), parts(rows)]))
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
    let all = count(rows, |row| row.verdict() != RowVerdict::Contradictory && row.holds_by_rounding());
    (all > 0).then(|| Prose::new(ROUNDED, [all.to_string()]))
}

fn calibrated(rows: &[&PaperRow]) -> Option<Prose> {
    let all = count(rows, chose_a_constant);
    let missed = count(rows, |row| chose_a_constant(row) && row.verdict() == RowVerdict::Missed);
    (all > 0).then(|| Prose::new(CALIBRATED, [all, missed].map(|figure| figure.to_string())))
}

/// Ratio of our value and the printed one, inverted if necessary so that it is at least 1; infinite for a value that
/// has not the sign of the printed one.
fn distance(row: &PaperRow) -> f64 {
    let ratio = ratio(row);
    if ratio > 0.0 { ratio.max(1.0 / ratio) } else { f64::INFINITY }
}

fn ratio(row: &PaperRow) -> f64 {
    row.ours / row.target.value
}

fn farthest(rows: &[&PaperRow]) -> Option<Prose> {
    let missed = rows.iter().filter(|row| row.verdict() == RowVerdict::Missed);
    let row = missed.max_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let figures = [row.target.what.clone(), row.device.to_owned(), row.target.place.clone(), number(ratio(row), 2)];
    Some(Prose::new(FARTHEST, figures))
}

/// Verdicts in the order of the chart: the first two have the colors of the tally.
const ORDER: [RowVerdict; 9] = [
    RowVerdict::Predicted,
    RowVerdict::Missed,
    RowVerdict::OrderOnly,
    RowVerdict::Consistent,
    RowVerdict::ByConstruction,
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
    let drawn = rows.iter().filter(|row| row.verdict() != RowVerdict::Reduced && distance(row).is_finite()).count();
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
