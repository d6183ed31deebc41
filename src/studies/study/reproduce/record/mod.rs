//! Recorded runs at full size, which judge the rows of entries that take minutes to hours of processor time.
//!
//! A record is a file of `src/studies/records`, which the program contains: what a run on models of the printed size
//! found, with its command, version, commit and times. It has no verdicts: rows are judged by the bounds of the data.
//!
//! docs/decisions/0026-recorded-rows.md says why.

mod cells;
mod file;
mod made;

use std::sync::LazyLock;

pub use file::EntryRecord;
pub use made::{RecordMade, RecordStatus};

use super::shared::Shared;
use super::{ENTRIES, EntryFindings, PaperRow, ReproduceEntry, RowSource, StudyError};

static RECORDS: LazyLock<Result<Vec<EntryRecord>, String>> = LazyLock::new(|| {
    let recorded = ENTRIES.iter().filter_map(|entry| Some((entry.id, entry.record?)));
    recorded.map(|(id, text)| EntryRecord::parse(id, text)).collect()
});

/// Returns the record of an entry that the program contains.
///
/// # Errors
/// If a file is malformed.
pub fn recorded(entry: &ReproduceEntry) -> Result<Option<&'static EntryRecord>, StudyError> {
    let records = RECORDS.as_deref().map_err(|reason| StudyError::new("reproduce::record", reason.as_str()))?;
    Ok(records.iter().find(|record| record.entry() == entry.id))
}

/// Returns the findings of an entry's record; computes them where there is none, and at full size.
pub(super) fn findings(entry: &ReproduceEntry, full_size: bool, shared: &Shared) -> Result<EntryFindings, StudyError> {
    match recorded(entry)? {
        Some(record) if full_size => Ok(compared(record, entry.run(shared)?)),
        Some(record) => record.findings(),
        None => entry.run(shared),
    }
}

/// Holds the rows of a run at full size against those of the entry's record.
fn compared(record: &'static EntryRecord, mut found: EntryFindings) -> EntryFindings {
    let source = |row: &PaperRow| match record.values(&row.target.id) {
        None => RowSource::Computed,
        Some(recorded) if same_bits(row.values(), recorded.clone()) => RowSource::Confirmed,
        Some(mut recorded) => RowSource::Differs { recorded: recorded.next().unwrap_or(f64::NAN) },
    };
    found.rows.iter_mut().for_each(|row| row.source = source(row));
    let differ = found.rows.iter().filter(|row| row.differs()).count();
    EntryFindings { record: Some(RecordStatus::Computed { made: record.made(), differ }), ..found }
}

/// Returns `true` if numbers have the same bits; one NaN is as good as another.
fn same_bits(some: impl Iterator<Item = f64>, others: impl Iterator<Item = f64>) -> bool {
    let bits = |value: f64| if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() };
    some.map(bits).eq(others.map(bits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Cell, Table};
    use crate::study::reproduce::{Contradiction, Dependence, Method, paper_row};

    const ENTRY: &str = "cpca-coherence";

    /// Findings of every kind that a record keeps: readings, a range, a contradiction.
    fn found(value: f64) -> EntryFindings {
        let row =
            |id: &str, dependence| paper_row(id, ("r300", Method::Pipeline), (value, dependence)).expect("a figure");
        let contradiction = Contradiction::if_holds(true, "two rates of one signal");
        let on = Dependence::Calibrated { on: "this figure" };
        let rows = vec![
            row("cpca/rate-bird-rec", Dependence::Counted).with_readings([value, value / 3.0]),
            row("cpca/rate-bird-sc", Dependence::Predicted { from: "overdraw" }).contradicted(contradiction),
            row("cpca/rate-bird-both", on).confined([1.0, f64::INFINITY], "a tree"),
        ];
        let mut table = Table::of("Points", "points error");
        table.push(["10,000".into(), Cell::measured(value / 7.0).marked("*")]);
        let text = vec!["Of 10,000 points".to_owned()];
        EntryFindings { rows, text, tables: vec![table], questions: vec!["which?"], ..EntryFindings::default() }
    }

    /// The record of such findings, as the program contains records.
    fn record(value: f64) -> &'static EntryRecord {
        let text = EntryRecord::new(ENTRY, &found(value), RecordMade::default()).text().expect("a file");
        Box::leak(Box::new(EntryRecord::parse(ENTRY, &text).expect("what was written")))
    }

    /// A record gives the findings of its run again. Verdicts follow from bounds and are not in the file.
    #[test]
    fn records_round_trip() {
        let (full, judged) = (found(10.0), record(10.0).findings().expect("the figures"));
        let mut rows = judged.rows[judged.rows.len() - full.rows.len()..].to_vec();
        assert_eq!(
            rows.iter().map(PaperRow::verdict).collect::<Vec<_>>(),
            full.rows.iter().map(PaperRow::verdict).collect::<Vec<_>>()
        );
        assert!(rows.iter().all(|row| row.source == RowSource::Recorded));
        rows.iter_mut().for_each(|row| row.source = RowSource::Computed);
        assert_eq!(rows, full.rows);
        let words = |found: &EntryFindings| (found.text.clone(), found.questions.clone(), found.tables.clone());
        assert_eq!(words(&judged), words(&full));
    }

    #[test]
    fn files_of_other_entries_and_without_cells_are_refused() {
        let text = EntryRecord::new(ENTRY, &found(10.0), RecordMade::default()).text().expect("a file");
        let refused = |entry, text: &str| EntryRecord::parse(entry, text).expect_err("refused");
        assert!(refused("cpca-figure-2", &text).contains("found that of `cpca-coherence`"));
        assert!(refused(ENTRY, &text.replace("measured", "guessed")).contains("expected a cell"));
        assert!(refused(ENTRY, "").contains("missing field"));
    }

    #[test]
    fn a_run_at_full_size_is_held_against_its_record() {
        let sources = |value: f64| compared(record(10.0), found(value)).rows.into_iter().map(|row| row.source);
        assert!(sources(10.0).all(|source| source == RowSource::Confirmed));
        assert!(sources(10.0_f64.next_up()).all(|source| source == RowSource::Differs { recorded: 10.0 }));
    }
}
