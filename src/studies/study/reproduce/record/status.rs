//! Relation of an entry's findings to its record.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::error::StaleRecord;
use crate::report::words::counted;
use crate::study::reproduce::prose::{Prose, number};

const RECORDED: &str = "Rows and tables are recorded: `{}`, version {} ({}), {}. Pictures and charts are drawn anew on reduced models: a smoke test, whose rows \
    were those of the record to the bit.";
const CONFIRMED: &str = "All is computed anew at full size, and has the bits of the record: `{}`, version {} ({}), {}.";
const DIFFERS: &str = "All is computed anew at full size; {} not as recorded: `{}`, version {} ({}), {}. Either the record is of another program, or this \
    program does not compute the same everywhere.";
const STALE: &str = "The recorded run at full size is of another program: {}.";
const MISSING: &str = "No run at full size is recorded.";
const REDUCED: &str = "{} Rows are of reduced models, a smoke test, and are neither judged nor counted.";

/// How a record was made.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordMade {
    /// Command line that computes the same.
    pub command: String,
    /// Version of the program.
    pub version: String,
    /// Commit of its sources.
    pub commit: String,
    /// Processor time of all threads, in seconds; none where the system does not say it.
    pub processor_s: Option<f64>,
    /// Time on the wall clock, in seconds.
    pub wall_s: f64,
}

/// Relation of an entry's findings to its record, for entries with a choice of model size.
#[derive(Clone, Debug, PartialEq)]
pub enum RecordStatus {
    /// Rows and tables are those of the record.
    Recorded(RecordMade),
    /// Computed at full size, beside a record.
    Computed {
        /// How the record was made.
        made: RecordMade,
        /// Number of rows that are not as recorded.
        differ: usize,
    },
    /// Computed at full size, and there is no record.
    New,
    /// Rows are of reduced models, because the record is of another program or there is none.
    Reduced(Option<StaleRecord>),
}

impl RecordStatus {
    /// Sentence on the findings; `None` if there is nothing to say.
    pub fn sentence(&self) -> Option<Prose> {
        let made = |made: &RecordMade| {
            let seconds = |time: f64, what: &str| format!("{} s {what}", number(time, 0));
            let processor = made.processor_s.map(|time| seconds(time, "of processor time"));
            let times = processor.into_iter().chain([seconds(made.wall_s, "on the clock")]).collect::<Vec<_>>();
            [made.command.clone(), made.version.clone(), made.commit.clone(), times.join(" and ")]
        };
        Some(match self {
            Self::Recorded(by) => Prose::new(RECORDED, made(by)),
            Self::Computed { made: by, differ: 0 } => Prose::new(CONFIRMED, made(by)),
            Self::Computed { made: by, differ } => {
                let rows = counted(*differ as u64, "row is", "rows are");
                Prose::new(DIFFERS, [rows].into_iter().chain(made(by)))
            }
            Self::New => return None,
            Self::Reduced(stale) => {
                let why = stale.as_ref().map(|stale| Prose::new(STALE, [stale.to_string()]));
                Prose::new(REDUCED, [why.map_or_else(|| MISSING.to_owned(), |why| why.to_string())])
            }
        })
    }

    /// The same for programs: how the record was made, and why it is not used.
    pub(in crate::study::reproduce) fn json(&self) -> Value {
        match self {
            Self::Recorded(made) | Self::Computed { made, .. } => json!(made),
            Self::New | Self::Reduced(None) => Value::Null,
            Self::Reduced(Some(stale)) => json!({ "stale": stale.to_string() }),
        }
    }
}
