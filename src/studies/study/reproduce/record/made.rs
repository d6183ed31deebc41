//! Origins of records, and the relation of an entry's findings to its record.

use serde::{Deserialize, Serialize};

use crate::report::words::counted;
use crate::study::reproduce::prose::{number, paragraph};

const RUN: &str = "`{}`, version {} ({}), {}";
const RECORDED: &str = "Rows and tables are recorded: {}.";
const CONFIRMED: &str = "All rows were recomputed at full size, with the same bits as the record: {}.";
const DIFFERS: &str = "All rows were recomputed at full size; {} from the record: {}. \
    Either a different version of the program made the record, or this version computes other bits on this machine.";

/// Provenance of a record.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordMade {
    /// Command line that computes the same result.
    pub command: String,
    /// Version of the program.
    pub version: String,
    /// Commit of its sources.
    pub commit: String,
    /// Processor time of all threads, in seconds; `None` if the system does not report it.
    pub processor_s: Option<f64>,
    /// Wall-clock time, in seconds.
    pub wall_s: f64,
}

/// Relation of an entry's findings to its record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RecordStatus {
    /// The findings come from the record.
    Recorded(&'static RecordMade),
    /// Computed at full size, and compared with a record.
    Computed {
        /// Provenance of the record.
        made: &'static RecordMade,
        /// Number of rows that differ from the record.
        differ: usize,
    },
}

impl RecordStatus {
    /// Provenance of the record.
    pub const fn made(&self) -> &'static RecordMade {
        match self {
            Self::Recorded(made) | Self::Computed { made, .. } => made,
        }
    }

    /// Sentence about the findings' source.
    pub fn sentence(&self) -> String {
        let made = self.made();
        let seconds = |time: f64, what: &str| format!("{} s {what}", number(time, 0));
        let processor = made.processor_s.map(|time| seconds(time, "of processor time"));
        let times = processor.into_iter().chain([seconds(made.wall_s, "of wall-clock time")]).collect::<Vec<_>>();
        let run = paragraph(RUN, &[&made.command, &made.version, &made.commit, &times.join(" and ")]);
        match self {
            Self::Recorded(_) => paragraph(RECORDED, &[&run]),
            Self::Computed { differ: 0, .. } => paragraph(CONFIRMED, &[&run]),
            Self::Computed { differ, .. } => {
                paragraph(DIFFERS, &[&counted(*differ as u64, "row differs", "rows differ"), &run])
            }
        }
    }
}
