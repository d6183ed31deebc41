//! "Clustered Principal Components": its figures on compression, Table 1, the table of section 7, and the appendix.
//!
//! The paper's models and BRDFs are not available. Our models, made by code, have the printed numbers of vertices, or
//! at most a sixteenth of them with the same fraction of the clusters ([`ModelSize`]), so the number of points per
//! cluster is the same. The rows for errors and overdraw compare which of two values is larger.

pub(super) mod appendix;
pub(super) mod coherence;
pub(super) mod figure_10;
pub(super) mod figure_11;
pub(super) mod figure_2;
pub(super) mod figure_3;
pub(super) mod figure_6;
pub(super) mod figure_7;
pub(super) mod figure_8;
pub(super) mod figure_9;
mod rates;
mod signals;
pub(super) mod table_1;

pub use figure_2::crossings;
pub use figure_3::reaching;
pub(super) use rates::timed;

use rates::{CARD, REGISTERS};

use super::error::RunResult;
use super::shared::{Shared, SharedResult};
use super::{
    Contradiction, Dependence, EntryFindings, HOST, Method, ModelSize, PaperRow, StudyError, TimedWork, ends, number,
    paper_row, paragraph, printed, printed_value,
};
const SECTION_6: &str = "Nothing is run: sizes follow from printed sizes by the formulas of sections 4.1 and 6.2. A \
    register holds 4 numbers, and each vector takes whole registers; the paper divides without rounding up. Per \
    frame, the host multiplies every mean and every vector by the light of three channels. Without compression, it \
    multiplies the matrix of every vertex instead.";

/// Sections 4.1, 6 and 6.2: numbers, registers and host work. The rows are expressions in `src/studies/papers`.
pub(super) fn section_6(_: &Shared) -> Result<EntryFindings, StudyError> {
    Ok(EntryFindings { text: vec![SECTION_6.into()], ..EntryFindings::default() })
}

/// Row for a value that follows from the paper's equations alone.
fn equation(id: &str, ours: f64) -> Result<PaperRow, StudyError> {
    paper_row(&format!("cpca/{id}"), (HOST, Method::Equation), (ours, Dependence::Counted))
}

fn solved(id: &str, ours: f64) -> Result<PaperRow, StudyError> {
    super::solved(&format!("cpca/{id}"), ours)
}
