//! "All-Frequency Precomputed Radiance Transfer for Glossy Objects" (Liu, Sloan, Shum, Snyder 2004).

mod counts;
mod factors;
mod figures;
mod forms;
mod models;
mod roughness;
mod table_1;

pub(super) use counts::findings as counts;
pub(super) use factors::findings as factors;
pub(super) use figures::findings as figures;
pub(super) use table_1::findings as table_1;

use super::pipeline::failed;
use super::shared::Shared;
use super::{
    Bound, EntryFindings, Method, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Setting, Standing, Sweep,
    number,
};

/// Name of the host on which solvers run.
const HOST: &str = "host";
