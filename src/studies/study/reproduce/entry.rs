//! Entries of the reproduction, and their findings.

use super::shared::Shared;
use super::{PaperRow, Prose, StudyError};
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
}

/// Table or figure of a paper.
#[derive(Clone, Copy, Debug)]
pub struct ReproduceEntry {
    /// Name on the command line.
    pub id: &'static str,
    /// Title, with the place where it is printed.
    pub title: &'static str,
    pub(super) work: fn(&Shared) -> Result<EntryFindings, StudyError>,
}

/// Entries with their findings.
pub type Reproduced = Vec<(ReproduceEntry, EntryFindings)>;
