//! Entries as tables, files and a page.

use super::{Findings, NamedChart, Reproduced, Row, Verdict};
use crate::report::{Cell, Page, Provenance, ReportError, Table};
use crate::study::leaky_teapot_report::NamedFile;

const HEADINGS: [&str; 17] = [
    "entry",
    "what",
    "device",
    "method",
    "place",
    "origin",
    "unit",
    "paper",
    "ours",
    "difference_%",
    "standing",
    "printed_inputs",
    "bound",
    "low",
    "high",
    "verdict",
    "explanation",
];

fn all(found: &Reproduced) -> impl Iterator<Item = (&'static str, &Row)> {
    found.iter().flat_map(|(entry, found)| found.rows.iter().map(|row| (entry.id, row)))
}

/// Every row with all that is known of it, for machines.
pub fn rows(found: &Reproduced) -> Table {
    let mut table = Table::new("The papers' figures and ours", &HEADINGS);
    for (entry, row) in all(found) {
        let [low, high] = limits(row);
        let target = &row.target;
        table.push([
            entry.into(),
            row.what.as_str().into(),
            row.device.into(),
            row.method.word().into(),
            target.place.into(),
            [target.origin.word(), target.origin.how()].join(" ").trim().into(),
            target.unit.into(),
            target.value.into(),
            rounded(row.ours, 1000.0).into(),
            rounded(100.0 * row.difference(), 10.0).into(),
            row.standing.word().into(),
            row.standing.inputs().into(),
            row.bound.text().into(),
            low,
            high,
            row.verdict().word().into(),
            row.explanation().map(super::Explanation::text).into(),
        ]);
    }
    table
}

fn limits(row: &Row) -> [Cell; 2] {
    let limit = |value: Option<f64>| value.map(|value| rounded(value, 100.0)).into();
    let interval = row.bound.interval(&row.target);
    [limit(interval.map(|[low, _]| low)), limit(interval.map(|[_, high]| high))]
}

const SHOWN: [&str; 10] =
    ["what", "device", "method", "place", "unit", "paper", "ours", "difference_%", "bound", "verdict"];

fn shown(row: &Row) -> [Cell; 10] {
    let target = &row.target;
    let steps = if row.ours.abs() < 1000.0 { 10.0 } else { 1.0 };
    let steps = if row.ours.abs() < 10.0 { 100.0 } else { steps };
    [
        row.what.as_str().into(),
        row.device.into(),
        row.method.word().into(),
        target.place.into(),
        target.unit.into(),
        target.text().into(),
        rounded(row.ours, steps).into(),
        rounded(100.0 * row.difference(), 10.0).into(),
        row.bound.text().into(),
        row.verdict().word().into(),
    ]
}

fn calibrated(row: &Row) -> bool {
    matches!(row.standing, super::Standing::Calibrated { .. })
}

/// The rows as people read them: predictions and counts; and apart from them what was calibrated.
pub fn tables(found: &Reproduced) -> [Table; 2] {
    let of = |title: &str, wanted: bool| {
        let mut table = Table::new(title, &SHOWN);
        all(found).filter(|(_, row)| calibrated(row) == wanted).for_each(|(_, row)| table.push(shown(row)));
        table
    };
    [of("Predicted and counted", false), of("Calibrated: no evidence", true)]
}

/// Where the paper's figures come from if they are not printed, what rows were calibrated on, and what reaches those outside their bounds.
pub fn notes(found: &Reproduced) -> Table {
    let mut table = Table::new("Origins, calibrations and explanations", &["what", "place", "paper", "says", "of"]);
    for (_, row) in all(found) {
        let mut note = |kind: &str, text: &str| {
            if !text.is_empty() {
                table.push([
                    row.what.as_str().into(),
                    row.target.place.into(),
                    row.target.text().into(),
                    kind.into(),
                    text.into(),
                ]);
            }
        };
        note(row.target.origin.word(), row.target.origin.how());
        if calibrated(row) {
            note(row.standing.word(), row.standing.inputs());
        }
        note("explained", &row.explanation().map(super::Explanation::text).unwrap_or_default());
    }
    table
}

/// How many rows came out how.
pub fn tally(found: &Reproduced) -> Table {
    let mut table = Table::new("Tally", &["verdict", "rows"]);
    for verdict in Verdict::ALL {
        table.push([verdict.word().into(), count(found, verdict).into()]);
    }
    table
}

fn count(found: &Reproduced, verdict: Verdict) -> usize {
    all(found).filter(|(_, row)| row.verdict() == verdict).count()
}

/// The tally in one line.
pub fn tally_line(found: &Reproduced) -> String {
    let part = |verdict: Verdict| format!("{} {}", count(found, verdict), verdict.word());
    Verdict::ALL.map(part).join(", ")
}

/// What would have to be known to say why rows are off: each question once, with the entry that asks first.
pub fn questions(found: &Reproduced) -> Vec<(&'static str, &'static str)> {
    let mut all: Vec<(&str, &str)> = Vec::new();
    for (entry, question) in found.iter().flat_map(|(entry, found)| found.questions.iter().map(|q| (entry.id, *q))) {
        if !all.iter().any(|(_, asked)| *asked == question) {
            all.push((entry, question));
        }
    }
    all
}

/// Whether no figure is missed.
pub fn held(found: &Reproduced) -> bool {
    count(found, Verdict::Missed) == 0
}

/// The files of a reproduction: `index.html`, `rows.csv`, `tally.csv`, `reproduce.json` and a drawing a chart.
///
/// # Errors
/// If a table or drawing cannot be encoded.
pub fn files(found: &Reproduced, provenance: &Provenance) -> Result<Vec<NamedFile>, ReportError> {
    let mut files = vec![
        ("index.html".to_owned(), page(found, provenance)?.html().into_bytes()),
        ("rows.csv".to_owned(), rows(found).csv()?.into_bytes()),
        ("tally.csv".to_owned(), tally(found).csv()?.into_bytes()),
    ];
    let mut document = serde_json::to_vec_pretty(&json(found, provenance))
        .map_err(|e| ReportError::Encode { format: "JSON", reason: e.to_string() })?;
    document.push(b'\n');
    files.push(("reproduce.json".to_owned(), document));
    for NamedChart { name, chart, .. } in found.iter().flat_map(|(_, found)| &found.charts) {
        files.push((format!("{name}.svg"), chart.svg()?.into_bytes()));
    }
    Ok(files)
}

/// Everything as JSON.
pub fn json(found: &Reproduced, provenance: &Provenance) -> serde_json::Value {
    let tables = |found: &Findings| -> Vec<_> {
        let table = |t: &Table| serde_json::json!({ "title": t.title(), "rows": t.json() });
        found.tables.iter().map(table).collect()
    };
    let entry = |(entry, found): &(super::Entry, Findings)| {
        serde_json::json!({
            "id": entry.id, "title": entry.title, "open_questions": found.questions, "tables": tables(found),
        })
    };
    serde_json::json!({
        "provenance": provenance, "tally": tally(found).json(), "rows": rows(found).json(),
        "entries": found.iter().map(entry).collect::<Vec<_>>(),
    })
}

const HOW: &str = "The papers' figures beside ours. A figure is printed, implied by printed ones, or inferred by us. Ours is predicted, counted, or \
    calibrated, which means that the figure chose a constant of the model: those stand apart and are no evidence. A row is reproduced \
    within a bound that was stated before ours was worked out: every printed digit where a paper's own equation is \
    worked with its printed rates; {} % of the paper's value for predictions, or of the gain over the host alone where the host was calibrated. \
    Outside it is missed, unless a sweep of this run over something that the papers leave open reaches the value without losing \
    another row that holds: then it is explained, with the setting. Differences are shares of the paper's value.";

fn page(found: &Reproduced, provenance: &Provenance) -> Result<Page, ReportError> {
    let how = super::Prose::new(HOW, [super::number(100.0 * super::Bound::SHARE, 0)]);
    let mut page =
        Page::new("The papers' figures, reproduced", provenance.clone()).text(how.to_string()).table(tally(found));
    for table in tables(found).into_iter().chain([notes(found)]).filter(|table| !table.rows().is_empty()) {
        page = page.table(table);
    }
    for (entry, found) in found {
        page = page.heading(entry.title);
        for paragraph in &found.text {
            page = page.text(paragraph.to_string());
        }
        for question in &found.questions {
            page = page.text(format!("Open: {question}"));
        }
        for chart in &found.charts {
            page = page.drawing(chart.chart.svg()?, chart.caption.to_string());
        }
        for table in &found.tables {
            page = page.table(table.clone());
        }
    }
    Ok(page)
}

/// A value to whole parts of `steps` in one.
pub(super) fn rounded(value: f64, steps: f64) -> f64 {
    // Plus 0, so that nothing reads -0.
    (value * steps).round() / steps + 0.0
}
