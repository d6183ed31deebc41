//! Errors of records: files that are refused, and records of another program.

use thiserror::Error;

use super::super::StudyError;

/// Error of a file of a recorded run.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum RecordError {
    /// The file is no record.
    #[error("the record of `{entry}`: {reason}")]
    Malformed {
        /// Entry.
        entry: String,
        /// Place and reason.
        reason: String,
    },
    /// The file was changed after it was recorded.
    #[error("the record of `{entry}` has digest {stated}, and what stands in it {found}: it was changed by hand")]
    Edited {
        /// Entry.
        entry: String,
        /// Digest in the file.
        stated: String,
        /// Digest of what stands below it.
        found: String,
    },
    /// The file is the record of another entry.
    #[error("expected the record of `{expected}`, found that of `{found}`")]
    Entry {
        /// Entry whose name the file has.
        expected: String,
        /// Entry in the file.
        found: String,
    },
}

impl From<RecordError> for StudyError {
    fn from(error: RecordError) -> Self {
        Self::coded("reproduce::record", error)
            .with_help("`crossbar reproduce ID --record FOLDER` records the entry anew")
    }
}

/// Reason why a record is not of this program, in words. Numbers have all digits.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct StaleRecord(String);

impl StaleRecord {
    /// Inputs have another digest; `none` is that of a model that is not there.
    pub(super) fn of_digests(inputs: &str, recorded: &str, found: &str) -> Self {
        Self(format!("{inputs} digest {found}, and had {recorded}"))
    }

    /// The run on reduced models gives other values for a row, ours first.
    pub(super) fn of_values(figure: &str, recorded: &[f64], found: &[f64]) -> Self {
        Self(format!("reduced models give {found:?} for `{figure}`, and gave {recorded:?}"))
    }

    /// The entry has other rows, sentences or sweeps.
    pub(super) fn of_structure(what: &str, recorded: &str, found: &str) -> Self {
        Self(format!("the entry has {found} {what}, and the record {recorded}"))
    }
}
