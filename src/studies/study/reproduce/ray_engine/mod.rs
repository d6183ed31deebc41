//! "The Ray Engine": its rates, equation 11, figure 7, and tables 1 to 5.
//!
//! The tables are rays per second of whole renderings. The paper's host is known by one value, the 135,812 rays per
//! second of Table 3's first row; it calibrates the scale of the host model, on our counts for our teapot room.
//! Everything else is predicted: the engine's work is run and counted, and the card's time is that of equation 11 and
//! its commands. Scenes, pictures and octree are ours, since none of the paper's is printed. The influence of such
//! choices is swept: the octree of the host alone ([`sweeps::host_leaf`]), the costs of commands
//! ([`sweeps::commands`]), and the definition of a ray on the card ([`shares`]).

mod engine_run;
mod equation_11;
mod figure_7;
mod pipeline;
mod radeon_8500;
mod shares;
mod speed_ups;
mod stated;
mod sweeps;
mod table_1;
mod table_3;
mod table_4;
mod table_5;
mod teapot;
mod vertex_variant;
mod workload;

pub(super) use equation_11::findings as equation_11;
pub(super) use figure_7::findings as figure_7;
pub use pipeline::{DUAL_TEXTURED, screen_quad};
pub(super) use radeon_8500::findings as radeon_8500;
pub(super) use table_1::findings as table_1;
pub(super) use table_3::findings as table_3;
pub(super) use table_4::findings as table_4;
pub(super) use table_5::findings as table_5;
pub(super) use vertex_variant::findings as vertex_variant;

use stated::{QUESTION, RATE, commands, how, speed_up};

use super::error::{failed, figure, no_time};
use super::shared::{Shared, SharedResult};
use super::{
    Dependence, EntryFindings, Method, PaperRow, Setting, StudyError, Sweep, number, paper_row, paragraph, printed,
    printed_value,
};
