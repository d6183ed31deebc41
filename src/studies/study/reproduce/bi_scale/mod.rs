//! The paper on real-time all-frequency bi-scale transfer by biclustering.

mod counts;
mod display;
mod figure_6;
mod figure_8;
mod figures;
mod frames;
mod models;
mod scenes;
mod table_1;
mod table_2;

pub(super) use counts::findings as counts;
pub(super) use figure_6::findings as figure_6;
pub(super) use figure_8::findings as figure_8;
pub(super) use figures::findings as figures;
pub(super) use frames::findings as frames;
pub(super) use table_1::findings as table_1;
pub(super) use table_2::findings as table_2;

use super::error::failed;
use super::shared::Shared;
use super::{
    Contradiction, Dependence, EntryFindings, Method, ModelSize, PaperFigure, PaperRow, StudyError, number, paper_row,
    paragraph, printed, printed_value,
};
use scenes::HOST;

/// Row of a value that is computed in f64 and uses no printed one.
fn solved(id: &str, ours: f64) -> Result<PaperRow, StudyError> {
    paper_row(&format!("bi-scale/{id}"), (HOST, Method::Solver), (ours, Dependence::Counted))
}
