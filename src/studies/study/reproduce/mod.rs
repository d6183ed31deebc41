//! Reproduction of the papers' printed values: one file per entry, each a list of rows with tables and charts.
//!
//! The papers' values, their origins and the bounds of the judged values are dated data ([`figures`]). Every row has
//! one of these values, our value, and the printed values on which ours depends; the verdict follows from these. A row
//! outside its bound is missed, with two exceptions: a sweep of the same run over something that the paper leaves open
//! reaches the printed value ([`Sweep`]), or the paper contradicts itself and our value agrees with one of its values
//! ([`Contradiction`]).
//!
//! Entries whose models take minutes to hours at full size take their rows from recorded runs ([`EntryRecord`]).

mod all_frequency;
mod bi_scale;
mod cpca;
mod entries;
mod entry;
mod error;
mod overview;
mod paper;
mod papers;
mod prose;
mod radiosity;
mod ray_engine;
mod record;
pub mod report;
mod row;
mod shared;
mod subsurface;

use crate::report::Findings;
use crate::study::{ProgressFn, Study};
use shared::{ModelSize, Shared};

use crate::study::StudyError;
pub use entries::{ENTRIES, choose, timed};
pub use entry::{EntryFindings, ReproduceEntry, Reproduced, TimedWork};
use paper::{HOST, drawn, equations, row as paper_row, solved, value as printed_value};
pub use paper::{figures, printed};
pub use papers::Paper;
use prose::{ends, number, paragraph};
pub use record::{EntryRecord, RecordMade, RecordStatus, recorded};
pub use row::{
    Bound, Contradiction, Dependence, Explanation, Judgement, Method, MissClass, Origin, PaperEquation, PaperFigure,
    PaperRow, RowSource, RowVerdict, Setting, Sweep,
};

/// Functions that tests call directly, because no short run reaches their cases.
#[doc(hidden)]
pub mod tested {
    pub use super::all_frequency::bunny_in_pieces;
    pub use super::cpca::{crossings, reaching};
    pub use super::overview::summary_lines;
    pub use super::paper::parse_figures;
    pub use super::record::compared;
}

/// Parameters of the study.
#[derive(Clone, Debug)]
pub struct Parameters {
    /// Entries to reproduce.
    pub entries: Vec<ReproduceEntry>,
    /// `true` to compute recorded entries anew, at full size.
    pub full_size: bool,
}

/// Computes entries, one after the other; if an entry has a record ([`recorded`]), it is computed only at full size.
/// Renderings and runs that several entries of a paper need are made once. `progress` is called with the name of each
/// entry. Fails with the error of the first failing entry, if a record is malformed, and if `full_size` is set for
/// entries none of which has a record.
pub fn reproduce(
    entries: &[ReproduceEntry],
    full_size: bool,
    progress: &mut ProgressFn<'_>,
) -> Result<Reproduced, StudyError> {
    if full_size && entries.iter().all(|entry| entry.record.is_none()) {
        let what = "expected a recorded entry, since only recorded runs can be repeated at full size";
        let help = "without the option, these entries are computed in full";
        return Err(StudyError::new("reproduce::no_record", what).with_help(help));
    }
    let mut found = Reproduced::new();
    for of_paper in entries.chunk_by(|one, next| one.paper == next.paper) {
        let shared = Shared::new(ModelSize::Printed);
        for entry in of_paper {
            progress(entry.id, found.len() as u64, entries.len() as u64);
            found.push((*entry, record::findings(entry, full_size, &shared)?));
        }
    }
    Ok(found)
}

impl Study for Parameters {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        Ok(report::findings(&reproduce(&self.entries, self.full_size, progress)?))
    }
}
