//! "All-Frequency Precomputed Radiance Transfer for Glossy Objects" (Liu, Sloan, Shum, Snyder 2004).

mod counts;
mod factors;
mod forms;
mod roughness;

pub(super) use counts::findings as counts;
pub(super) use factors::findings as factors;

use super::pipeline::failed;
use super::shared::Shared;
use super::{
    Bound, EntryFindings, Method, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Setting, Standing, Sweep,
    number,
};

/// Where solvers run.
const HOST: &str = "host";
