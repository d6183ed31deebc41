//! Section 4 of the radiosity and subsurface paper: its counts, and the times of its Table 1.

pub(super) mod counts;
pub(super) mod frames;
mod gather;
pub(super) mod table_1;

use gather::{CARD, LINKS};

use super::error::{RunResult, no_time};
use super::shared::Shared;
use super::{
    Contradiction, Dependence, EntryFindings, Method, PaperRow, Setting, StudyError, Sweep, TimedWork, drawn, ends,
    number, paper_row, paragraph, printed_value, solved,
};
