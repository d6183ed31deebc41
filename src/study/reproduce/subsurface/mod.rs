//! Section 4 of the radiosity and subsurface paper: what it counts, and the times of its Table 1.

mod counts;
mod gather;
mod table_1;

pub(super) use counts::findings as counts;
pub(super) use table_1::findings as table_1;

use super::pipeline::failed;
use super::{
    Bound, EntryFindings, Method, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Setting, Standing, Sweep,
    number,
};

/// Links per texel in the paper's runs.
const LINKS: usize = 16;
/// The card of Table 1: "a GeForce FX 5900".
const CARD: &str = "fx5900";
