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

/// Reason why a record is not of this program. Numbers are shown with all digits.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Error)]
pub enum StaleRecord {
    /// The paper's figures were others.
    #[error("the paper's printed figures have digest {found}, and had {recorded}")]
    Figures {
        /// Digest in the record.
        recorded: String,
        /// Digest of today's figures.
        found: String,
    },
    /// A model of the entry was another one.
    #[error("the model `{model}` has digest {found}, and had {recorded}")]
    Model {
        /// Model.
        model: String,
        /// Digest in the record, `none` for a model that it does not have.
        recorded: String,
        /// Digest of today's model, `none` if there is none.
        found: String,
    },
    /// Parameters of the run were others.
    #[error("the parameters of a run at full size have digest {found}, and had {recorded}")]
    Parameters {
        /// Digest in the record.
        recorded: String,
        /// Digest of today's parameters.
        found: String,
    },
    /// The run on reduced models gives another value.
    #[error("reduced models give {found:?} for `{figure}`, and gave {recorded:?}")]
    Value {
        /// Figure of the row.
        figure: String,
        /// Values in the record.
        recorded: Vec<f64>,
        /// Values of this run.
        found: Vec<f64>,
    },
    /// The entry has other rows, sentences or sweeps.
    #[error("the entry has {found} {what}, and the record {recorded}")]
    Structure {
        /// Rows, for example.
        what: &'static str,
        /// Those of the record.
        recorded: String,
        /// Those of this run.
        found: String,
    },
}
