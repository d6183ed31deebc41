//! "All-Frequency Precomputed Radiance Transfer for Glossy Objects" (Liu, Sloan, Shum, Snyder 2004).

mod codings;
mod counts;
mod factors;
mod figures;
mod forms;
mod models;
mod roughness;
mod segments;
mod table_1;

pub(super) use counts::findings as counts;
pub(super) use factors::findings as factors;
pub(super) use figures::findings as figures;
pub use models::bunny_in_pieces;
pub(super) use table_1::findings as table_1;

use super::error::failed;
use super::shared::Shared;
use super::{
    Dependence, EntryFindings, Method, PaperRow, Setting, StudyError, Sweep, number, paper_row, paragraph, printed,
    printed_value,
};

/// Name of the host on which solvers run.
const HOST: &str = "host";

/// Row of a value that is computed in f64 and uses no printed one.
fn solved(id: &str, ours: f64) -> Result<PaperRow, StudyError> {
    paper_row(&format!("all-frequency/{id}"), (HOST, Method::Solver), (ours, Dependence::Counted))
}
