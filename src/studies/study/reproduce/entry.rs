//! Entries of the reproduction, their findings, and work that benches time.

use std::rc::Rc;

use refsim::timing::Picoseconds;

use super::shared::Shared;
use super::{ModelSize, Paper, PaperRow, RecordStatus, StudyError, equations, printed};
use crate::kept::KeptResults;
use crate::report::{NamedChart, Table};

/// Findings of one entry.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EntryFindings {
    /// Paragraphs about the method.
    pub text: Vec<String>,
    /// Printed values of the paper, each with ours.
    pub rows: Vec<PaperRow>,
    /// Open questions whose answers could explain rows outside their bounds.
    pub questions: Vec<&'static str>,
    /// Further tables.
    pub tables: Vec<Table>,
    /// Charts.
    pub charts: Vec<NamedChart>,
    /// Relation to the record, if there is one.
    pub record: Option<RecordStatus>,
}

impl EntryFindings {
    /// Creates findings without charts.
    pub(super) fn new(
        text: impl Into<Vec<String>>,
        rows: impl Into<Vec<PaperRow>>,
        questions: impl Into<Vec<&'static str>>,
        tables: impl Into<Vec<Table>>,
    ) -> Self {
        let (text, rows, questions, tables) = (text.into(), rows.into(), questions.into(), tables.into());
        Self { text, rows, questions, tables, ..Self::default() }
    }
}

/// Table or figure of a paper.
#[derive(Clone, Copy, Debug)]
pub struct ReproduceEntry {
    /// Paper.
    pub paper: Paper,
    /// Name on the command line; it begins with the paper's name.
    pub id: &'static str,
    /// Title, including the table, figure or section of the paper.
    pub title: &'static str,
    pub(super) work: fn(&Shared) -> Result<EntryFindings, StudyError>,
    /// Text of the record, for an entry that takes minutes to hours at full size.
    pub(super) record: Option<&'static str>,
}

impl ReproduceEntry {
    /// Computes the entry. Rows that are expressions of printed values come first, then those that its code computes.
    pub(super) fn run(&self, shared: &Shared) -> Result<EntryFindings, StudyError> {
        let (mut rows, found) = (equations(self.id)?, (self.work)(shared)?);
        rows.extend(found.rows);
        Ok(EntryFindings { rows, ..found })
    }

    /// Computes the entry at full size, alone. Entries that take hours store finished pieces, and reuse them. Fails as
    /// the entry does, and if pieces cannot be stored.
    pub fn at_full_size(&self, kept: Rc<KeptResults>) -> Result<EntryFindings, StudyError> {
        self.run(&Shared::new(ModelSize::Printed).keeping(Some(kept)))
    }

    /// Computes the entry alone on reduced models, without verdicts: shows that a run at full size would not fail.
    /// Fails as the entry does.
    pub fn on_reduced_models(&self) -> Result<EntryFindings, StudyError> {
        self.run(&Shared::new(ModelSize::Reduced))
    }
}

/// Entries with their findings.
pub type Reproduced = Vec<(ReproduceEntry, EntryFindings)>;

/// Work of a system with its modelled time.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedWork {
    /// Name of the printed figure, as in `radiosity/jacobi-rate`.
    pub figure: &'static str,
    /// Printed value, with its unit and its section of the paper.
    pub printed: String,
    /// Card.
    pub device: &'static str,
    /// Number of items, such as ray-triangle tests; 1 for a frame or a pass.
    pub items: u64,
    /// Modelled time of all items.
    pub time: Picoseconds,
}

impl TimedWork {
    pub(super) fn new(figure: &'static str, device: &'static str, time: Picoseconds) -> Result<Self, StudyError> {
        let found = printed(figure)?;
        let printed = format!("{} {} ({})", found.text(), found.unit, found.place);
        Ok(Self { figure, printed, device, items: 1, time })
    }
}
