//! Recorded runs at full size: they decide the verdicts of entries that take minutes to hours of processor time.
//!
//! A record is a file of `src/studies/records`, embedded in the program. It holds the result of a run on models of the
//! printed size, with its command, version, commit and times. It has no verdicts: the bounds in the data judge rows.
//!
//! docs/decisions/0026-recorded-rows.md explains this.

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

/// Returns an entry's record from the program. Fails if a file is malformed.
pub fn recorded(entry: &ReproduceEntry) -> Result<Option<&'static EntryRecord>, StudyError> {
    let records = RECORDS.as_deref().map_err(|reason| StudyError::new("reproduce::record", reason.as_str()))?;
    Ok(records.iter().find(|record| record.entry == entry.id))
}

/// Returns the findings of an entry's record; computes them if there is no record, or if `full_size` is set.
pub(super) fn findings(entry: &ReproduceEntry, full_size: bool, shared: &Shared) -> Result<EntryFindings, StudyError> {
    match recorded(entry)? {
        Some(record) if full_size => Ok(compared(record, entry.run(shared)?)),
        Some(record) => record.findings(),
        None => entry.run(shared),
    }
}

/// Compares the rows of a run at full size with the entry's record.
pub fn compared(record: &'static EntryRecord, mut found: EntryFindings) -> EntryFindings {
    let source = |row: &PaperRow| match record.values(&row.target.id) {
        None => RowSource::Computed,
        Some(recorded) if same_bits(row.values(), recorded.clone()) => RowSource::Confirmed,
        Some(mut recorded) => RowSource::Differs { recorded: recorded.next().unwrap_or(f64::NAN) },
    };
    found.rows.iter_mut().for_each(|row| row.source = source(row));
    let differ = found.rows.iter().filter(|row| row.differs()).count();
    EntryFindings { record: Some(RecordStatus::Computed { made: &record.made, differ }), ..found }
}

/// Returns `true` if numbers have the same bits; all NaN count as equal.
fn same_bits(some: impl Iterator<Item = f64>, others: impl Iterator<Item = f64>) -> bool {
    let bits = |value: f64| if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() };
    some.map(bits).eq(others.map(bits))
}
