//! The paper on real-time all-frequency bi-scale transfer by biclustering.

pub(super) mod figure_6;
pub(super) mod figure_8;
pub(super) mod figures;
pub(super) mod frames;
mod models;
pub(super) mod table_1;
pub(super) mod table_2;

use super::error::RunResult;
use super::shared::Shared;
use super::{
    Contradiction, Dependence, EntryFindings, HOST, Method, ModelSize, PaperFigure, PaperRow, StudyError, TimedWork,
    drawn, paper_row, paragraph, printed, printed_value,
};
const COUNTS: &str = "Nothing is run. Each nonzero value of the matrix costs two operations. A dense matrix takes 1 byte per value, and \
    biclusters take 4 bytes per operation: a row takes 4 bytes and one operation; a column takes 8 bytes, for its place and its value, and two \
    operations. A texel has 3 bytes. We inferred these byte counts from the printed sizes, so rows in megabytes are calibrated.";
const QUESTION: &str = "why the printed size of the small bunny's dense matrix is larger than its vertices imply, \
    while the other five sizes fit.";

/// Values of both tables that follow from the sizes alone. The rows are expressions in `src/studies/papers`.
pub(super) fn counts(_: &Shared) -> Result<EntryFindings, StudyError> {
    Ok(EntryFindings::new([COUNTS.into()], [], [QUESTION], []))
}

fn solved(id: &str, ours: f64) -> Result<PaperRow, StudyError> {
    super::solved(&format!("bi-scale/{id}"), ours)
}
