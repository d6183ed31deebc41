//! Findings of the study from those of the entries.

use serde_json::json;
use strum::VariantArray as _;

use super::overview::{overview, overview_chart, tally as counts};
use super::papers::summary_lines;
use super::{EntryChart, PaperRow, Reproduced, RowVerdict};
use crate::report::{Cell, Findings, FoundTable, NamedChart, Table, Verdict};

const COLUMNS: &str = "entry what device method place origin unit paper ours difference_% standing printed_inputs bound low high \
     verdict explanation";

fn all(found: &Reproduced) -> impl Iterator<Item = (&'static str, &PaperRow)> {
    found.iter().flat_map(|(entry, found)| found.rows.iter().map(|row| (entry.id, row)))
}

/// Table of every row with all its attributes, for programs.
fn rows(found: &Reproduced) -> Table {
    let mut table = Table::of("The papers' figures and ours", COLUMNS);
    for (entry, row) in all(found) {
        let [low, high] = limits(row);
        let target = &row.target;
        table.push([
            entry.into(),
            row.what.as_str().into(),
            row.device.into(),
            row.method.to_string().into(),
            target.place.into(),
            format!("{} {}", target.origin, target.origin.how()).trim().into(),
            target.unit.into(),
            target.value.into(),
            row.ours.into(),
            Cell::percent(100.0 * row.difference()),
            row.standing.to_string().into(),
            row.standing.inputs().into(),
            row.bound.text().into(),
            low,
            high,
            row.verdict().to_string().into(),
            row.explanation().map(super::Explanation::text).into(),
        ]);
    }
    table
}

fn limits(row: &PaperRow) -> [Cell; 2] {
    let limit = |value: Option<f64>| value.into();
    let interval = row.bound.interval(&row.target);
    [limit(interval.map(|[low, _]| low)), limit(interval.map(|[_, high]| high))]
}

const SHOWN: [&str; 10] =
    ["what", "place", "unit", "paper", "ours", "difference_%", "verdict", "bound", "device", "method"];

fn shown(row: &PaperRow) -> [Cell; 10] {
    let target = &row.target;
    [
        row.what.as_str().into(),
        target.place.into(),
        target.unit.into(),
        target.cell(),
        target.beside(row.ours),
        Cell::decimals(100.0 * row.difference(), 1),
        row.verdict().to_string().into(),
        row.bound.text().into(),
        row.device.into(),
        row.method.to_string().into(),
    ]
}

fn calibrated(row: &PaperRow) -> bool {
    matches!(row.standing, super::Standing::Calibrated { .. })
}

/// Tables of the rows for people: predictions and counts; and separately the calibrated values.
pub fn tables(found: &Reproduced) -> [Table; 2] {
    let of = |title: &str, wanted: bool| {
        let mut table = Table::new(title, &SHOWN);
        for (entry, found) in found {
            for (n, row) in found.rows.iter().enumerate().filter(|(_, row)| calibrated(row) == wanted) {
                table.push_named(format!("{}.{}", entry.id, n + 1), shown(row));
            }
        }
        table
    };
    [of("Predicted and counted", false), of("Calibrated: no evidence", true)]
}

/// Table of notes: origins of values that are not printed, inputs of calibration, and explanations of rows outside
/// their bounds; each reason once, with its rows.
pub fn notes(found: &Reproduced) -> Table {
    let mut notes: Vec<([String; 2], Vec<String>)> = Vec::new();
    for (_, row) in all(found) {
        let name = format!("{} ({})", row.what, row.target.place);
        let mut note = |kind: &str, reason: String, row: String| {
            let key = [kind.to_owned(), reason];
            match notes.iter_mut().find(|(other, _)| *other == key) {
                Some((_, rows)) if rows.contains(&row) => {}
                Some((_, rows)) => rows.push(row),
                None => notes.push((key, vec![row])),
            }
        };
        if !row.target.origin.how().is_empty() {
            note(&row.target.origin.to_string(), row.target.origin.how().to_owned(), name.clone());
        }
        if calibrated(row) {
            note(&row.standing.to_string(), row.standing.inputs().to_owned(), name.clone());
        }
        if let Some(explanation) = row.explanation() {
            let value = row.target.beside(explanation.value()).text();
            note("explained", explanation.reason(), format!("{name}: {value} there"));
        }
    }
    let mut table = Table::of("Origins, calibrations and explanations", "count kind reason figures");
    for ([kind, reason], rows) in notes {
        table.push([rows.len().into(), kind.into(), reason.into(), rows.join("; ").into()]);
    }
    table
}

/// Table of the number of rows per verdict.
fn tally(found: &Reproduced) -> Table {
    let mut table = Table::of("Tally", "verdict rows");
    for verdict in RowVerdict::VARIANTS {
        table.push([verdict.to_string().into(), count(found, *verdict).into()]);
    }
    table
}

fn count(found: &Reproduced, verdict: RowVerdict) -> usize {
    all(found).filter(|(_, row)| row.verdict() == verdict).count()
}

/// Formats the tally in one line: explained rows do not count as reproduced.
pub fn tally_line(found: &Reproduced) -> String {
    let [reproduced, calibrated, explained, missed, vague] = [
        RowVerdict::Reproduced,
        RowVerdict::Calibrated,
        RowVerdict::Explained,
        RowVerdict::Missed,
        RowVerdict::TooVague,
    ]
    .map(|verdict| count(found, verdict));
    format!(
        "{} figures: {reproduced} reproduced; {} outside their bounds, {explained} of them explained and {missed} missed; \
         {calibrated} calibrated, no evidence; {vague} too vague to judge",
        all(found).count(),
        explained + missed,
    )
}

/// Open questions about rows outside their bounds: each once, with the first entry that asks it.
fn questions(found: &Reproduced) -> Vec<(&'static str, &'static str)> {
    let mut all: Vec<(&str, &str)> = Vec::new();
    for (entry, question) in found.iter().flat_map(|(entry, found)| found.questions.iter().map(|q| (entry.id, *q))) {
        if !all.iter().any(|(_, asked)| *asked == question) {
            all.push((entry, question));
        }
    }
    all
}

/// Returns `true` if no value is missed.
pub fn held(found: &Reproduced) -> bool {
    count(found, RowVerdict::Missed) == 0
}

const HOW: &str = "The papers' figures beside ours. A figure is printed, implied by printed ones, or inferred by us. Ours is predicted, counted, or \
    calibrated, which means that the figure chose a constant of the model: those stand apart and are no evidence. A row is reproduced \
    within a bound that was stated before ours was worked out: every printed digit where a paper's own equation is \
    worked with its printed rates; {} % of the paper's value for predictions, or of the gain over the host alone where the host was calibrated. \
    Outside it is missed, unless a sweep of this run over something that the papers leave open reaches the value without losing \
    another row that holds: then it is explained, with the setting. Differences are shares of the paper's value.";

pub(super) fn findings(found: &Reproduced) -> Findings {
    let mut all = Findings::new("The papers' figures, reproduced");
    overview(&mut all, found);
    all.summary_lines(summary_lines(found));
    let how = super::Prose::new(HOW, [super::number(100.0 * super::Bound::SHARE, 0)]);
    all.keep_table(FoundTable::from(tally(found)).csv("tally").field("tally"));
    all.keep_table(FoundTable::from(rows(found)).csv("rows").field("rows"));
    all.heading("All rows");
    overview_chart(&mut all, found);
    all.paragraph(how.to_string());
    tables(found).into_iter().chain([notes(found)]).for_each(|table| all.table(table));
    let mut entries = Vec::new();
    for (entry, found) in found {
        all.counted_heading(entry.title, counts(&found.rows.iter().collect::<Vec<_>>()));
        found.text.iter().for_each(|paragraph| all.paragraph(paragraph.to_string()));
        found.questions.iter().for_each(|question| all.paragraph(format!("Open: {question}")));
        for EntryChart { name, chart, caption } in &found.charts {
            let (name, chart, caption) = ((*name).to_owned(), chart.clone(), caption.to_string());
            all.chart(NamedChart { name, chart, caption });
        }
        if !found.pictures.is_empty() {
            all.pictures(found.pictures.clone());
        }
        found.tables.iter().for_each(|table| all.table(FoundTable::from(table.clone()).unprinted()));
        let tables = found.tables.iter().map(|table| json!({ "title": table.title(), "rows": table.json() }));
        entries.push(json!({
            "id": entry.id, "title": entry.title, "open_questions": found.questions,
            "tables": tables.collect::<Vec<_>>(),
        }));
    }
    all.field("entries", json!(entries));
    all.print(tally_line(found));
    for (entry, question) in questions(found) {
        all.print(format!("open ({entry}): {question}"));
    }
    all.conclude(Verdict::held(held(found)));
    all
}
