//! "Clustered Principal Components": its figures on compression, Table 1, the table of section 7, and the appendix.
//!
//! The paper's models and BRDFs are not available. Ours, made by code, have its vertex counts, or a sixteenth or less
//! of them with the same fraction of the clusters ([`ModelSize`]): the number of points per cluster is the same. The
//! rows on errors and overdraw compare which of two is larger.

mod appendix;
mod coherence;
mod drawn;
mod figure_10;
mod figure_11;
mod figure_2;
mod figure_3;
mod figure_6;
mod figure_7;
mod figure_8;
mod figure_9;
mod mesh_cost;
mod rates;
mod section_6;
mod shared;
mod signals;
mod table_1;
mod views;

pub(super) use appendix::findings as appendix;
pub(super) use coherence::findings as coherence;
pub use figure_2::crossings;
pub(super) use figure_2::findings as figure_2;
pub(super) use figure_3::findings as figure_3;
pub use figure_3::reaching;
pub(super) use figure_6::findings as figure_6;
pub(super) use figure_7::findings as figure_7;
pub(super) use figure_8::findings as figure_8;
pub(super) use figure_9::findings as figure_9;
pub(super) use figure_10::findings as figure_10;
pub(super) use figure_11::findings as figure_11;
pub(super) use section_6::findings as section_6;
pub(super) use table_1::findings as table_1;

use mesh_cost::REGISTERS;
use signals::HOST;

use super::error::failed;
use super::shared::Shared;
use super::{
    Contradiction, Dependence, EntryFindings, Method, ModelSize, PaperRow, StudyError, number, paper_row, paragraph,
    printed, printed_value,
};

/// Row of a value that follows from the paper's equations alone.
fn equation(id: &str, ours: f64) -> Result<PaperRow, StudyError> {
    paper_row(&format!("cpca/{id}"), (HOST, Method::Equation), (ours, Dependence::Counted))
}

/// Row of a value that is computed in f64 and uses no printed one.
fn solved(id: &str, ours: f64) -> Result<PaperRow, StudyError> {
    paper_row(&format!("cpca/{id}"), (HOST, Method::Solver), (ours, Dependence::Counted))
}
