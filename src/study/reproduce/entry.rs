//! An entry, and what it finds.

use super::shared::Shared;
use super::{PaperRow, Prose, ReproduceError};
use crate::report::{Chart, NamedPicture, Table};

/// A chart, the name of its file, and what stands under it.
#[derive(Clone, Debug, PartialEq)]
pub struct EntryChart {
    /// File name without folder and ending.
    pub name: &'static str,
    /// The chart.
    pub chart: Chart,
    /// What stands under it.
    pub caption: Prose,
}

/// What one entry found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EntryFindings {
    /// How it was done, as paragraphs.
    pub text: Vec<Prose>,
    /// The paper's figures beside ours.
    pub rows: Vec<PaperRow>,
    /// What would have to be known to say why rows are off.
    pub questions: Vec<&'static str>,
    /// What else there is to show.
    pub tables: Vec<Table>,
    /// Plots.
    pub charts: Vec<EntryChart>,
    /// Pictures.
    pub pictures: Vec<NamedPicture>,
}

/// A table or figure of a paper.
#[derive(Clone, Copy, Debug)]
pub struct ReproduceEntry {
    /// The name on the command line.
    pub id: &'static str,
    /// What it is, and where it is printed.
    pub title: &'static str,
    pub(super) work: fn(&Shared) -> Result<EntryFindings, ReproduceError>,
}

/// Entries with what they found.
pub type Reproduced = Vec<(ReproduceEntry, EntryFindings)>;
