//! "The Ray Engine": its rates, equation 11, Figure 7, and Tables 1 to 5.
//!
//! The tables print rays per second of whole renderings. One printed value describes the paper's host: the 135,812 rays
//! per second of Table 3's first row. With our counts for our teapot room, it calibrates the scale of the host model.
//! Everything else is predicted: the engine runs and its work is counted; the card's time follows from equation 11 and
//! the card's commands. Scenes, pictures and octree are ours, since the paper does not print its own. Sweeps show the
//! influence of such choices: the octree of the host alone and the costs of commands ([`speed_ups`]), and the
//! definition of a ray on the card ([`shares`]).

pub(super) mod block_shapes;
pub(super) mod equation_11;
pub(super) mod figure_1;
pub(super) mod figure_7;
mod pipeline;
pub(super) mod radeon_8500;
mod shares;
mod speed_ups;
pub(super) mod table_1;
pub(super) mod tables;
pub(super) mod vertex_variant;
mod workload;

use super::error::{RunResult, figure, no_time};
use super::shared::{Shared, SharedResult};
use super::{
    Dependence, EntryFindings, Method, PaperRow, Setting, StudyError, Sweep, TimedWork, drawn, paper_row, paragraph,
    printed, printed_value,
};
