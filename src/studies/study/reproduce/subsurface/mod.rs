//! Section 4 of the radiosity and subsurface paper: its counts, and the times of its Table 1.

mod counts;
mod frame_cost;
mod frames;
mod gather;
mod table_1;

pub(super) use counts::findings as counts;
pub(super) use frames::findings as frames;
use gather::CARD;
use gather::LINKS;
pub(super) use table_1::findings as table_1;

use super::error::{failed, no_time};
use super::shared::Shared;
use super::{
    Contradiction, Dependence, EntryFindings, Method, PaperRow, Setting, StudyError, Sweep, number, paper_row,
    paragraph, printed_value,
};
