//! Contribution of a figure to the entry.

use super::{PaperRow, Prose};
use crate::report::{PictureGrid, Table};

/// Contribution of a figure to the entry.
#[derive(Default)]
pub(super) struct FigureParts {
    pub(super) text: Vec<Prose>,
    pub(super) rows: Vec<PaperRow>,
    pub(super) tables: Vec<Table>,
    pub(super) pictures: Vec<PictureGrid>,
}
