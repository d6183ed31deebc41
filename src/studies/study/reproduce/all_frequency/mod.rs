//! "All-Frequency Precomputed Radiance Transfer for Glossy Objects" (Liu, Sloan, Shum, Snyder 2004).

pub(super) mod counts;
pub(super) mod factors;
pub(super) mod figures;
mod forms;
mod models;
mod segments;
pub(super) mod table_1;

pub use models::bunny_in_pieces;

use super::error::RunResult;
use super::shared::Shared;
use super::{
    Dependence, EntryFindings, HOST, Method, PaperRow, Setting, StudyError, Sweep, ends, paper_row, paragraph,
    printed_value,
};

fn solved(id: &str, ours: f64) -> Result<PaperRow, StudyError> {
    super::solved(&format!("all-frequency/{id}"), ours)
}
