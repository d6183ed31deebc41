//! Entries as tables, files and a page.

use super::{Entry, Findings, Judgement, NamedChart, Row};
use crate::report::{Cell, Page, Provenance, ReportError, Table};
use crate::study::leaky_teapot_report::NamedFile;

/// Entries with what they found.
pub type Reproduced = Vec<(Entry, Findings)>;

const HEADINGS: [&str; 12] = [
    "entry",
    "what",
    "device",
    "place",
    "unit",
    "printed",
    "rates",
    "rates_%",
    "rates_says",
    "pipeline",
    "pipeline_%",
    "pipeline_says",
];

/// The printed figures of all entries, ours beside them.
pub fn rows(found: &Reproduced) -> Table {
    let mut table = Table::new("Printed figures and ours", &HEADINGS);
    for (entry, row) in found.iter().flat_map(|(entry, found)| found.rows.iter().map(move |row| (entry, row))) {
        let [rates, pipeline] = [row.rates.as_ref(), row.pipeline.as_ref()].map(|m| m.map(|m| m.value));
        let head: [Cell; 6] = [
            entry.id.into(),
            row.what.as_str().into(),
            row.device.into(),
            row.printed.place.into(),
            row.printed.unit.into(),
            row.printed.value.into(),
        ];
        let level = |value: Option<f64>, judged: Judgement| -> [Cell; 3] {
            let error = value.map(|v| rounded(100.0 * row.symmetric_error(v), 10.0));
            [value.map(|v| rounded(v, 1000.0)).into(), error.into(), judged.word().into()]
        };
        let levels = level(rates, row.judge_rates()).into_iter().chain(level(pipeline, row.judge_pipeline()));
        table.push(head.into_iter().chain(levels));
    }
    table
}

/// What went into the rows, and why those that are off are off.
pub fn notes(found: &Reproduced) -> Table {
    let mut table = Table::new("Calibrations and explanations", &["entry", "what", "device", "calibrated_on", "note"]);
    let mut last: &str = "";
    for (entry, row) in found.iter().flat_map(|(entry, found)| found.rows.iter().map(move |row| (entry, row))) {
        let on = |model: &'static str, modelled: &Option<super::Modelled>| {
            modelled.as_ref().and_then(|m| m.calibrated_on).map(|figures| format!("{model}: {figures}"))
        };
        let on: Vec<String> = on("rates", &row.rates).into_iter().chain(on("pipeline", &row.pipeline)).collect();
        if !on.is_empty() || !row.note.is_empty() {
            // One note often serves several rows.
            let said = std::mem::replace(&mut last, &row.note);
            let note = if said == row.note && !said.is_empty() { "as above" } else { row.note.as_str() };
            table.push([
                entry.id.into(),
                row.what.as_str().into(),
                row.device.into(),
                on.join("; ").into(),
                note.into(),
            ]);
        }
    }
    table
}

/// Whether every figure is met, or its miss explained.
pub fn held(found: &Reproduced) -> bool {
    let met = |row: &Row| row.judge_rates() != Judgement::Missed && row.judge_pipeline() != Judgement::Missed;
    found.iter().flat_map(|(_, found)| &found.rows).all(met)
}

/// The files of a reproduction: `index.html`, `rows.csv`, `reproduce.json` and a drawing a chart.
///
/// # Errors
/// If a table or drawing cannot be encoded.
pub fn files(found: &Reproduced, provenance: &Provenance) -> Result<Vec<NamedFile>, ReportError> {
    let mut files = vec![
        ("index.html".to_owned(), page(found, provenance)?.html().into_bytes()),
        ("rows.csv".to_owned(), rows(found).csv()?.into_bytes()),
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
    let entries: Vec<_> = found
        .iter()
        .map(|(entry, found)| serde_json::json!({ "id": entry.id, "title": entry.title, "tables": tables(found) }))
        .collect();
    serde_json::json!({
        "provenance": provenance, "rows": rows(found).json(), "notes": notes(found).json(), "entries": entries,
    })
}

fn page(found: &Reproduced, provenance: &Provenance) -> Result<Page, ReportError> {
    let mut page = Page::new("The papers' figures, reproduced", provenance.clone())
        .text(
            "Printed figures beside what two models give. The rates model is the paper's own cost equation with its printed \
             rates, and has to give every printed digit; the pipeline model works from clocks, slots and bytes, and has to come \
             within 15 %. Errors are symmetric: the difference in units of the smaller value. A calibrated value took the \
             figure itself as input and proves nothing.",
        )
        .table(rows(found))
        .table(notes(found));
    for (entry, found) in found {
        page = page.heading(entry.title);
        for paragraph in &found.text {
            page = page.text(paragraph);
        }
        for chart in &found.charts {
            page = page.drawing(chart.chart.svg()?, &chart.caption);
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
