//! Entries of the reproduction, and their findings.

use super::full_size::{FullModel, FullSize};
use super::shared::Shared;
use super::{Paper, PaperRow, Prose, RecordStatus, RowVerdict, StudyError, equations};
use crate::report::{Chart, PictureGrid, Table};

/// Chart with its file name and caption.
#[derive(Clone, Debug, PartialEq)]
pub struct EntryChart {
    /// File name without folder and extension.
    pub name: &'static str,
    /// The chart.
    pub chart: Chart,
    /// Caption.
    pub caption: Prose,
}

/// Findings of one entry.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EntryFindings {
    /// Method, in paragraphs.
    pub text: Vec<Prose>,
    /// Printed values of the paper with ours.
    pub rows: Vec<PaperRow>,
    /// Open questions whose answers would explain rows outside their bounds.
    pub questions: Vec<&'static str>,
    /// Further tables.
    pub tables: Vec<Table>,
    /// Charts.
    pub charts: Vec<EntryChart>,
    /// Pictures, a grid per figure.
    pub pictures: Vec<PictureGrid>,
    /// Relation to the record, where the size of models decides the rows.
    pub record: Option<RecordStatus>,
}

impl EntryFindings {
    /// Rows that tallies count: not those of reduced models.
    pub fn counted(&self) -> impl Iterator<Item = &PaperRow> {
        self.rows.iter().filter(|row| row.verdict() != RowVerdict::Reduced)
    }
}

/// Table or figure of a paper.
#[derive(Clone, Copy, Debug)]
pub struct ReproduceEntry {
    /// Paper.
    pub paper: Paper,
    /// Name on the command line, which begins with the paper's.
    pub id: &'static str,
    /// Title, with the place where it is printed.
    pub title: &'static str,
    work: EntryWork,
    /// For an entry whose rows depend on the size of models.
    pub(super) full_size: Option<FullSize>,
}

type EntryWork = fn(&Shared) -> Result<EntryFindings, StudyError>;

impl Paper {
    /// Entry whose rows do not depend on the size of models.
    pub(super) const fn entry(self, id: &'static str, title: &'static str, work: EntryWork) -> ReproduceEntry {
        ReproduceEntry { paper: self, id, title, work, full_size: None }
    }
}

impl ReproduceEntry {
    /// The same with rows that depend on the size of models: these at full size, and the parameters of such runs.
    pub(super) const fn sized(self, models: &'static [FullModel], parameters: fn() -> String) -> Self {
        Self { full_size: Some(FullSize { models, parameters }), ..self }
    }

    /// Computes the entry. Rows that are expressions of printed values come before those of its code.
    pub(super) fn run(&self, shared: &Shared) -> Result<EntryFindings, StudyError> {
        let (mut rows, found) = (equations(self.id)?, (self.work)(shared)?);
        rows.extend(found.rows);
        Ok(EntryFindings { rows, ..found })
    }

    /// Returns `true` if the entry's rows depend on the size of models: it can be recorded.
    pub const fn is_sized(&self) -> bool {
        self.full_size.is_some()
    }
}

/// Entries with their findings.
pub type Reproduced = Vec<(ReproduceEntry, EntryFindings)>;
