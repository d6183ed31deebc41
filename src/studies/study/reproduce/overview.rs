//! Overview of all rows: conclusion, tally, and a chart of our values relative to the papers'.

use strum::VariantArray as _;

use super::{EntryChart, MissClass, PaperRow, Reproduced, RowSource, RowVerdict};
use crate::report::words::{counted, listed};
use crate::report::{Chart, Findings, NamedChart, Scale, Series, TallyEntry, Tone};

/// Adds conclusion and tally to the findings.
pub(super) fn overview(all: &mut Findings, found: &Reproduced) {
    let every: Vec<&PaperRow> = found.iter().flat_map(|(_, found)| &found.rows).collect();
    let rows: Vec<&PaperRow> = found.iter().flat_map(|(_, found)| found.counted()).collect();
    let evidence = chose_none(found);
    let of = |of: &dyn Fn(&PaperRow) -> bool| count(&evidence, of);
    let sentences = [
        judged(&evidence).map(|judged| format!("{judged}.")),
        differ(&rows),
        classes(&evidence),
        counts(&[
            ("Recorded at full size", of(&is_recorded)),
            ("computed anew with the same bits", of(&|row| row.source == RowSource::Confirmed)),
        ]),
        counts(&[("Met only by the rounding of the print", of(&needs_rounding))]),
        counts(&[
            ("Beside these, chose a constant of a model and are no evidence", rows.len() - evidence.len()),
            ("missed all the same", count(&rows, |row| row.is_calibrated() && row.verdict() == RowVerdict::Missed)),
        ]),
        counts(&[("Of reduced models alone, and not judged", every.len() - rows.len())]),
    ];
    sentences.into_iter().flatten().for_each(|sentence| all.conclusion(sentence));
    for entry in tally(&rows) {
        all.tally(entry.count, [&entry.what, &entry.what], entry.tone);
    }
}

/// Sentence of counts, each behind what it counts; `None` if the first is 0. Other counts of 0 are left out.
fn counts(parts: &[(&str, usize)]) -> Option<String> {
    let (_, first) = parts.first()?;
    let shown = parts.iter().filter(|(_, count)| *count > 0).map(|(what, count)| format!("{what}: {count}"));
    (*first > 0).then(|| shown.collect::<Vec<_>>().join("; ") + ".")
}

/// Returns `true` for a row with the value of a recorded run.
pub(super) const fn is_recorded(row: &PaperRow) -> bool {
    !matches!(row.source, RowSource::Computed | RowSource::Reduced)
}

fn needs_rounding(row: &PaperRow) -> bool {
    row.verdict() != RowVerdict::Contradictory && row.holds_by_rounding()
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

/// Counted rows that chose no constant.
pub(super) fn chose_none(found: &Reproduced) -> Vec<&PaperRow> {
    found.iter().flat_map(|(_, found)| found.counted()).filter(|row| !row.is_calibrated()).collect()
}

/// Numbers of rows by verdict, in words, without those that are 0. Their sum is the number of rows.
pub(super) fn parts(rows: &[&PaperRow]) -> String {
    let of = |verdict: RowVerdict| (count(rows, |row| row.verdict() == verdict), verdict);
    let counts = RowVerdict::counted().map(of).filter(|(count, _)| *count > 0);
    listed(&counts.map(|(count, verdict)| format!("{count} {}", verdict.of_rows())).collect::<Vec<_>>())
}

/// Number of rows that chose no constant, and the numbers by verdict; `None` without such rows.
pub(super) fn judged(rows: &[&PaperRow]) -> Option<String> {
    let all = counted(rows.len() as u64, "figure", "figures");
    (!rows.is_empty()).then(|| format!("{all} chose no constant: {}", parts(rows)))
}

/// Number of missed rows by class.
fn classes(rows: &[&PaperRow]) -> Option<String> {
    let of = |class: MissClass| (count(rows, |row| row.missed() == Some(class)), class);
    let counts = MissClass::VARIANTS.iter().copied().map(of).filter(|(count, _)| *count > 0);
    let counts: Vec<String> = counts.map(|(count, class)| format!("{class} {count}")).collect();
    (!counts.is_empty()).then(|| format!("Missed for what is in the way: {}.", counts.join(", ")))
}

/// Names of the rows that are not as recorded.
fn differ(rows: &[&PaperRow]) -> Option<String> {
    let names: Vec<&str> = rows.iter().filter(|row| row.differs()).map(|row| row.target.id.as_str()).collect();
    (!names.is_empty()).then(|| format!("Not as recorded: {}.", names.join(", ")))
}

fn ratio(row: &PaperRow) -> f64 {
    row.ours / row.target.value
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
    let is_drawn = |row: &PaperRow| row.verdict() != RowVerdict::Reduced && ratio(row) > 0.0 && ratio(row).is_finite();
    let drawn = count(rows, is_drawn);
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
