//! The paper on real-time all-frequency bi-scale transfer by biclustering.

pub(super) mod counts;
mod display;
pub(super) mod figure_6;
pub(super) mod figure_8;
pub(super) mod figures;
pub(super) mod frames;
mod models;
mod scenes;
pub(super) mod table_1;
pub(super) mod table_2;

use super::error::RunResult;
use super::shared::Shared;
use super::{
    Contradiction, Dependence, EntryFindings, Method, ModelSize, PaperFigure, PaperRow, StudyError, TimedWork, number,
    paper_row, paragraph, printed, printed_value,
};
use scenes::HOST;

/// Row for a value that is computed in f64 and does not use a printed value.
fn solved(id: &str, ours: f64) -> Result<PaperRow, StudyError> {
    paper_row(&format!("bi-scale/{id}"), (HOST, Method::Solver), (ours, Dependence::Counted))
}
