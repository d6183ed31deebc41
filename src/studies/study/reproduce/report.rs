//! Merges the entries' findings into the study's.

use serde_json::json;

pub use super::overview::evidence_line;
use super::overview::summary_lines;
use super::overview::{overview, rows as all_rows, tally};
use super::{Bound, Judgement, PaperFigure, PaperRow, Reproduced, StudyError, figures, paragraph};
use crate::report::{Cell, Findings, FoundTable, Table, Verdict};

const COLUMNS: &str = "entry figure what device method place origin unit paper ours least_reading most_reading difference_% source \
     dependence printed_inputs bound stated low high by_rounding verdict missed_for explanation contradiction";

fn all(found: &Reproduced) -> impl Iterator<Item = (&'static str, &PaperRow)> {
    found.iter().flat_map(|(entry, found)| found.rows.iter().map(|row| (entry.id, row)))
}

/// Table of every row with all its attributes, for programs.
fn rows(found: &Reproduced) -> Table {
    let mut table = Table::of("The papers' figures and ours", COLUMNS);
    for (entry, row) in all(found) {
        let [low, high] = cells(row.interval());
        let [least, most] = cells(row.range());
        let target = &row.target;
        table.push([
            entry.into(),
            target.id.as_str().into(),
            target.what.as_str().into(),
            row.device.into(),
            row.method.to_string().into(),
            target.place.as_str().into(),
            format!("{} {}", target.origin, target.origin.how()).trim().into(),
            target.unit.as_str().into(),
            target.value.into(),
            row.ours.into(),
            least,
            most,
            Cell::percent(100.0 * row.difference()),
            row.source.to_string().into(),
            row.dependence.to_string().into(),
            row.dependence.inputs().into(),
            row.bound.text().into(),
            target.stated.as_str().into(),
            low,
            high,
            row.holds_by_rounding().into(),
            row.verdict().to_string().into(),
            row.missed().map(|class| class.to_string()).into(),
            row.explanation().map(super::Explanation::text).into(),
            row.contradiction().map(|contradiction| contradiction.text().to_owned()).into(),
        ]);
    }
    table
}

fn cells(interval: Option<[f64; 2]>) -> [Cell; 2] {
    interval.map_or([Cell::Empty, Cell::Empty], |ends| ends.map(Cell::from))
}

const SHOWN: &str = "what place unit paper ours readings difference_% verdict missed_for bound source device method";

fn shown(row: &PaperRow) -> [Cell; 13] {
    let target = &row.target;
    let readings = row.range().map(|range| range.map(|end| target.beside(end).text()).join(" to "));
    let rounded = if row.holds_by_rounding() { ", only because of rounding in print" } else { "" };
    [
        target.what.as_str().into(),
        target.place.as_str().into(),
        target.unit.as_str().into(),
        target.cell(),
        target.beside(row.ours),
        readings.into(),
        Cell::decimals(100.0 * row.difference(), 1),
        row.verdict().to_string().into(),
        row.missed().map(|class| class.to_string()).into(),
        format!("{}{rounded}", row.bound.text()).into(),
        row.source.to_string().into(),
        row.device.into(),
        row.method.to_string().into(),
    ]
}

/// Tables of the rows for readers: first predictions and counts, then the calibrated values.
pub fn tables(found: &Reproduced) -> [Table; 2] {
    let of = |title: &str, wanted: bool| {
        let mut table = Table::of(title, SHOWN);
        for (entry, found) in found {
            for (n, row) in found.rows.iter().enumerate().filter(|(_, row)| row.is_calibrated() == wanted) {
                table.push_named(format!("{}.{}", entry.id, n + 1), shown(row));
            }
        }
        table
    };
    [of("Predicted and counted values", false), of("Calibrated values: not evidence", true)]
}

/// Table of notes: origins of values that are not printed, inputs of calibration, ranges that confine values,
/// explanations of rows outside their bounds, and contradictions within the paper. Each note appears once, with its
/// rows.
pub fn notes(found: &Reproduced) -> Table {
    let mut notes: Vec<([String; 2], Vec<String>)> = Vec::new();
    for (_, row) in all(found) {
        let name = format!("{} ({})", row.target.what, row.target.place);
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
        if row.is_calibrated() {
            note(&row.dependence.to_string(), row.dependence.inputs().to_owned(), name.clone());
        }
        if let Some(explanation) = row.explanation() {
            let value = row.target.beside(explanation.value).text();
            note("explained", explanation.reason(), format!("{name}: {value}"));
        }
        if let Some((_, why)) = row.confinement() {
            note("by construction", why.to_owned(), name.clone());
        }
        if let Some(contradiction) = row.contradiction() {
            note("contradictory", contradiction.text().to_owned(), name);
        }
    }
    let mut table = Table::of("Origins, calibrations, explanations and contradictions", "count kind reason figures");
    for ([kind, reason], rows) in notes {
        table.push([rows.len().into(), kind.into(), reason.into(), rows.join("; ").into()]);
    }
    table
}

/// Table of the printed figures that have no row, each with the reason, for papers that have a row in `found`.
fn unjudged(found: &Reproduced) -> Result<Table, StudyError> {
    let mut table = Table::of("Printed figures without a row", "figure what place value unit reason");
    let has_row = |figure: &&PaperFigure| all(found).any(|(_, row)| row.target.paper == figure.paper);
    for figure in figures()?.iter().filter(has_row) {
        if let Judgement::Not(reason) = &figure.judgement {
            let texts = [&figure.id, &figure.what, &figure.place].map(|text| Cell::from(text.as_str()));
            let rest = [figure.cell(), figure.unit.as_str().into(), reason.as_str().into()];
            table.push(texts.into_iter().chain(rest));
        }
    }
    Ok(table)
}

fn tally_table(found: &Reproduced) -> Table {
    let mut table = Table::of("Tally", "verdict rows");
    tally(all_rows(found)).into_iter().for_each(|entry| table.push([entry.what.into(), entry.count.into()]));
    table
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

/// Returns `true` if no value differs from its record. A missed row is a finding, not a failure.
fn as_recorded(found: &Reproduced) -> bool {
    !all_rows(found).any(PaperRow::differs)
}
const HOW: &str = "Each row compares a figure of a paper with our value. The figure is printed, implied by printed figures, or inferred by us. Every \
    bound has a date: most were restated on 2026-11-26, before the recorded runs, and the data list later changes and additions. A row within its bound is \
    \"predicted\" if our value is drawn, solved, counted or timed, and the bound is numerical: {} % of the paper's value or of its gain over the \
    host alone, or every digit for counts and solutions. It is \"order only\" if the bound only says which of two values is larger, \"by \
    construction\" if the bound admits every value that the computation can give, and \"consistency of print\" if our value follows from the paper's \
    numbers and equations alone. \"Calibrated\" values determined a constant of the model: they are not evidence. A bound must hold for all readings \
    that the text allows. A row outside its bound is \"missed\", with the cause if it is known. It is \"explained\" if this run varies something \
    that the papers leave open, and reaches the printed value without losing another row. If a paper contradicts itself and our value agrees with \
    one of its values, the row is \"contradictory\". Differences are relative to the paper's value. The source of a row is this run (computed), a \
    recorded run at full size (recorded), or both with the same bits.";

/// Maximum number of entries with printed tables; for more, the program prints a line per paper.
const PRINTED: usize = 3;

/// Merges the entries' findings into the study's.
pub fn findings(found: &Reproduced) -> Findings {
    let mut all = Findings::new("The papers' figures, reproduced");
    overview(&mut all, found);
    let lines = summary_lines(found);
    all.summary_lines(lines.clone());
    let how = paragraph(HOW, &[&(100.0 * Bound::SHARE)]);
    all.keep_table(FoundTable::from(tally_table(found)).csv("tally").field("tally"));
    all.keep_table(FoundTable::from(rows(found)).csv("rows").field("rows"));
    all.heading("All rows");
    all.paragraph(how);
    let is_short = found.len() <= PRINTED;
    let printed = |table: Table| if is_short { FoundTable::from(table) } else { FoundTable::from(table).unprinted() };
    tables(found).into_iter().chain([notes(found)]).for_each(|table| all.table(printed(table)));
    // The files are known to be valid: rows were read from them.
    if let Ok(table) = unjudged(found) {
        all.table(FoundTable::from(table).csv("unjudged").field("unjudged").unprinted());
    }
    let mut entries = Vec::new();
    for (entry, found) in found {
        all.counted_heading(entry.title, tally(found.rows.iter()));
        found.record.iter().for_each(|record| all.paragraph(record.sentence()));
        found.text.iter().for_each(|text| all.paragraph(text.as_str()));
        found.questions.iter().for_each(|question| all.paragraph(format!("Open: {question}")));
        found.charts.iter().for_each(|chart| all.chart(chart.clone()));
        found.tables.iter().for_each(|table| all.table(FoundTable::from(table.clone()).unprinted()));
        let tables = found.tables.iter().map(|table| json!({ "title": table.title(), "rows": table.json() }));
        entries.push(json!({
            "id": entry.id, "title": entry.title, "open_questions": found.questions,
            "record": found.record.map(|record| json!(record.made())), "tables": tables.collect::<Vec<_>>(),
        }));
    }
    all.field("entries", json!(entries));
    if is_short {
        questions(found).into_iter().for_each(|(entry, question)| all.print(format!("open ({entry}): {question}")));
    } else {
        lines.iter().for_each(|line| all.print(line.to_string()));
        all.print(
            "The page lists every row with its bound, and the open questions; rows.csv lists the rows for programs."
                .to_owned(),
        );
    }
    all.conclude(Verdict::held(as_recorded(found)));
    all
}
