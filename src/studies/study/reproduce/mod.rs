//! Reproduction of the papers' printed values: one file per entry, each a list of rows with tables and charts.
//!
//! The papers' values, their origins and the bounds of those that are judged are data with dates ([`figures`]). Every
//! row has one of them, and ours with the printed values that it depends on, which determine the verdict. A row outside
//! its bound counts as missed unless a sweep of the same run over something that the paper leaves open reaches the
//! printed value ([`Sweep`]), or the paper contradicts itself and ours agrees with one of its values
//! ([`Contradiction`]).
//!
//! Rows that depend on the size of models are those of recorded runs at full size ([`EntryRecord`]).

mod all_frequency;
mod bi_scale;
mod cpca;
mod entries;
mod entry;
mod error;
mod full_size;
mod model_size;
mod overview;
mod paper;
mod papers;
mod prose;
mod radiosity;
mod ray_engine;
mod record;
pub mod report;
mod row;
mod schedule;
mod shared;
mod sky;
mod subsurface;
mod summary;

use crate::report::{Findings, Provenance};
use crate::study::{ProgressFn, Study};

use crate::study::StudyError;
pub use entries::{ENTRIES, choose};
pub use entry::{EntryChart, EntryFindings, ReproduceEntry, Reproduced};
pub use model_size::ModelSize;
use paper::{equations, row as paper_row, value as printed_value};
pub use paper::{figures, printed};
pub use papers::Paper;
pub use prose::{Prose, number};
pub use ray_engine::{DUAL_TEXTURED, screen_quad};
pub use record::{EntryRecord, RecordError, RecordMade, RecordStatus, SmokeRun, StaleRecord, recorded};
pub use row::{
    Bound, Contradiction, Explanation, Judgement, Method, MissClass, Origin, PaperEquation, PaperFigure, PaperRow,
    RowSource, RowVerdict, Setting, Standing, Sweep,
};
pub use schedule::reproduce;

/// Parameters of the study.
#[derive(Clone, Debug)]
pub struct Parameters {
    /// Entries to reproduce.
    pub entries: Vec<ReproduceEntry>,
    /// Size of stand-in models.
    pub models: ModelSize,
}

impl Study for Parameters {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        Ok(report::findings(&reproduce(&self.entries, self.models, progress)?))
    }

    /// Entries choose their devices themselves, and nothing is random.
    fn provenance(&self, provenance: Provenance) -> Provenance {
        provenance
    }
}
