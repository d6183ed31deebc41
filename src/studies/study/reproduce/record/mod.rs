//! Recorded runs at full size, which judge the rows of entries with a choice of model size.
//!
//! A record is a file of `src/studies/records`, which the program contains: values, sweeps and tables of a run on
//! models of the printed size, with its command, version, commit and times. It has no verdicts: rows are judged anew,
//! by the bounds of the data and with the standing that the code gives them. Structure and words come from a
//! [`SmokeRun`] on reduced models, which also tells whether the record still is of this program: its values there must
//! be those of the record to the bit, as must figures, models and parameters by their digests.
//!
//! docs/decisions/0026-recorded-rows.md says why.

mod cells;
mod error;
mod file;
mod inputs;
mod smoke;
mod status;

pub use error::{RecordError, StaleRecord};
pub use file::EntryRecord;
pub use smoke::SmokeRun;
pub use status::{RecordMade, RecordStatus};

use super::shared::Shared;
use super::{EntryFindings, ModelSize, ReproduceEntry, StudyError};

/// Names of the entries with a record, and the files.
macro_rules! records {
    ($($id:literal),* $(,)?) => {
        &[$(($id, include_str!(concat!("../../../records/", $id, ".toml")))),*]
    };
}

/// Recorded entries with their files.
pub(super) const RECORDS: &[(&str, &str)] = records![
    "cpca-figure-2",
    "cpca-figures-3-4",
    "cpca-figure-6",
    "cpca-figure-7",
    "cpca-figure-8",
    "cpca-figure-9",
    "cpca-figure-10",
    "cpca-figure-11",
    "cpca-coherence",
    "cpca-table-1",
    "all-frequency-figures",
    "all-frequency-table-1",
    "bi-scale-figure-8",
    "bi-scale-figure-6",
    "bi-scale-table-1",
    "bi-scale-figures",
];

/// Returns the record of an entry that the program contains.
///
/// # Errors
/// If its file is malformed, or was changed by hand.
pub fn recorded(entry: &ReproduceEntry) -> Result<Option<EntryRecord>, StudyError> {
    let file = RECORDS.iter().find(|(id, _)| *id == entry.id);
    Ok(file.map(|(_, text)| EntryRecord::parse(entry.id, text)).transpose()?)
}

/// Computes an entry. Its rows are those of its record where the size of models decides them and `shared` has reduced
/// ones.
pub(super) fn findings(entry: &ReproduceEntry, shared: &Shared) -> Result<EntryFindings, StudyError> {
    if !entry.is_sized() {
        return entry.run(shared);
    }
    let record = recorded(entry)?;
    if shared.models == ModelSize::Printed {
        return Ok(smoke::compared(record.as_ref(), entry.run(shared)?));
    }
    Ok(SmokeRun::new(entry, shared)?.judged_by(record.as_ref()))
}
